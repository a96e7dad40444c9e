#pragma once

// Settings of encoding, exports and playing, from files (pacini.settings) and from programs.

#include "io/GivenParameters.h"
#include "io/PlaybackSettings.h"
#include "io/ReadWarnings.h"

#include <pacini/analysis/methods/MethodChoices.h>
#include <pacini/foundation/Description.h>
#include <pacini/foundation/Result.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace pacini
{

inline constexpr DocumentFormat settingsFormat{.name = "pacini.settings", .version = 1, .noun = "settings"};

/// Settings by part. Unset values keep their defaults.
struct Settings
{
    std::string method; ///< of encoding; empty: a2vt
    std::string preset; ///< whose values are among `encode`; empty: none
    GivenParameters encode;
    GivenParameters exporting; ///< part `export`
    bool hasEncode = false;    ///< the document has a part `encode`
    PlaybackSettings playback; ///< parts `pan`, `outputs`, `character` and `live`
};

/// The method of this name, a2vt where it is empty. Errors: invalidArgument, with the nearest name.
[[nodiscard]] Result<Method> chosenMethod(std::string_view name);

/// Sets all values that presets set to those of the preset of this name; values that are set later override it. Errors:
/// those of presetNamed().
[[nodiscard]] Result<void> usePreset(Settings& settings, std::string_view name);

/// The translation that `settings` ask for. Errors: invalidArgument at the name of a parameter that the method does not
/// have, or whose value is not allowed, and at `preset` for another method than a2vt.
[[nodiscard]] Result<TranslationParams> translationOf(const Settings& settings);

/// The entries of the part `encode`: `method`, `preset` and all parameters of translations, which override the preset.
void readEncodeSettings(FieldsReader& reader, Settings& settings);

/// Longer texts are refused.
inline constexpr std::size_t largestSettingsText = 1'000'000;

/// The entries of a settings document; errors are stored in the reader.
void readSettingsFields(FieldsReader& reader, Settings& settings);

/// Reads a document of settings; unknown keys are passed over with a warning each. Errors: those of FieldsReader, and
/// invalidArgument for values that are not allowed, with their place.
[[nodiscard]] Result<Settings> readSettings(std::string_view text, ReadWarnings* warnings = nullptr);

/// The document of a translation with all that its method can be set to; `usual` are the choices of the method where
/// nothing else is chosen. readSettings() gives the same translation.
[[nodiscard]] nlohmann::ordered_json settingsJson(const TranslationParams& translation, const MethodChoices& usual);

/// Returns all presets, each with its values that are not defaults.
[[nodiscard]] nlohmann::ordered_json presetsJson();

/// Descriptions of all parameters of translations, each with its methods.
[[nodiscard]] nlohmann::ordered_json translationDescriptionsJson();

} // namespace pacini
