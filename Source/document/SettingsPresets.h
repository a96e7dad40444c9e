#pragma once

// Presets that the user has saved, of the analysis, of the outputs, of the character and of the live parameters:
// settings files (pacini.settings) in a folder.

#include "io/PlaybackSettings.h"

#include <pacini/analysis/EncoderParams.h>
#include <pacini/foundation/Result.h>
#include <pacini/realtime/TranslatorParams.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini
{

/// One file for each preset, `NAME.json`. All of it [message].
class SettingsPresets
{
public:
    static constexpr std::size_t longestName = 80; ///< bytes
    static constexpr std::size_t most = 500;       ///< that are listed

    /// The folder need not exist: the first preset makes it.
    explicit SettingsPresets(std::filesystem::path wanted) : home(std::move(wanted)) {}

    /// The names of all presets, sorted; their files are not read. Hidden files are none.
    [[nodiscard]] std::vector<std::string> names() const;

    /// Files whose names cannot be those of presets, see presetNameDefect(): `where` are the files.
    [[nodiscard]] std::vector<Error> misnamed() const;

    /// The text of a preset. Errors: those of names, io for what is no file, and those of readWholeFile().
    [[nodiscard]] Result<std::string> text(const std::string& name) const;

    /// Whether there is something of this name, be it whole or broken.
    [[nodiscard]] bool exists(const std::string& name) const;

    [[nodiscard]] std::filesystem::path pathOf(const std::string& name) const;

    /// Writes a preset, the text of a settings file, as a whole or not at all. Errors: invalidArgument for a name that
    /// cannot be one, see presetNameDefect(); io or diskFull for a file that cannot be written, and for one that is
    /// there already unless it may be replaced.
    [[nodiscard]] Result<void> save(const std::string& name, const std::string& settings, bool replace) const;

    /// Errors: invalidArgument for a name that cannot be one, and for a new one that is another preset's; io.
    [[nodiscard]] Result<void> rename(const std::string& name, const std::string& wanted) const;

    /// Deletes the preset's file. Errors: those of names, and io.
    [[nodiscard]] Result<void> remove(const std::string& name) const;

    [[nodiscard]] const std::filesystem::path& folder() const noexcept { return home; }

private:
    [[nodiscard]] std::vector<std::string> stems() const;

    std::filesystem::path home;
};

/// The text of a settings file with all parameters of the analysis, which `pacini encode --settings` reads too.
[[nodiscard]] std::string analysisSettings(const EncoderParams& params);

/// The parameters of the analysis in a settings file. Errors: those of readSettingsFile() and translationOf(),
/// invalidArgument at `method` for another method than a2vt, and invalidData at `encode` where there is none.
[[nodiscard]] Result<EncoderParams> readAnalysisSettings(const std::filesystem::path& path);

/// The text of a settings file whose part `outputs` has these.
[[nodiscard]] std::string outputSettings(const OutputSettings& settings);

/// The part `outputs` of a settings file, 1 to 8 of them. Errors: those of readSettingsFile(), and invalidData at
/// `outputs` where there is none.
[[nodiscard]] Result<OutputSettings> readOutputSettings(const std::filesystem::path& path);

/// The text of a settings file whose part `character` has these.
[[nodiscard]] std::string characterSettings(const CharacterSettings& settings);

/// The part `character` of a settings file, else that of its part `live`, see characterOf(); what it does not state is
/// as a new clip has it. Errors: those of readSettingsFile(), and invalidData at `character` where there is neither.
[[nodiscard]] Result<CharacterSettings> readCharacterSettings(const std::filesystem::path& path);

/// The text of a settings file whose part `live` has these.
[[nodiscard]] std::string liveSettings(const TranslatorParams& params);

/// The part `live` of the text of a settings file; what it does not state has its default. Errors: those of
/// readSettings(), and invalidData at `live` where there is none.
[[nodiscard]] Result<TranslatorParams> readLiveSettings(std::string_view text);

} // namespace pacini
