#pragma once

// Presets that the user has saved, of the analysis, of the outputs and of the live character: settings files
// (pacini.settings) in a folder.

#include "document/HapticOutput.h"

#include <pacini/analysis/EncoderParams.h>
#include <pacini/foundation/Result.h>
#include <pacini/synthesis/Scene.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// One file for each preset, `NAME.json`. All of it [message].
class SettingsPresets
{
public:
    static constexpr std::size_t longestName = 80; ///< bytes
    static constexpr std::size_t most = 200;       ///< that are listed

    /// The folder need not exist: the first preset makes it.
    explicit SettingsPresets(std::filesystem::path wanted) : home(std::move(wanted)) {}

    /// The names of all presets, sorted; their files are not read.
    [[nodiscard]] std::vector<std::string> names() const;

    [[nodiscard]] std::filesystem::path pathOf(const std::string& name) const;

    /// Writes a preset, the text of a settings file, as a whole or not at all. Errors: invalidArgument for a name that
    /// cannot be one, see presetNameDefect(); io or diskFull for a file that cannot be written, and for one that is
    /// there already unless it may be replaced.
    [[nodiscard]] Result<void> save(const std::string& name, const std::string& settings, bool replace) const;

private:
    std::filesystem::path home;
};

/// The text of a settings file with all parameters of the analysis, which `pacini encode --settings` reads too.
[[nodiscard]] std::string analysisSettings(const EncoderParams& params);

/// The parameters of the analysis in a settings file. Errors: those of readSettingsFile() and translationOf(), and
/// invalidArgument at `method` for another method than a2vt.
[[nodiscard]] Result<EncoderParams> readAnalysisSettings(const std::filesystem::path& path);

/// Haptic outputs beside each other, and how a clip's position counts over them.
struct OutputSettings
{
    static constexpr std::size_t most = 8;

    std::vector<HapticOutput> outputs;
    std::optional<PanLaw> pan; ///< none: every output plays all of it
    bool operator==(const OutputSettings&) const = default;
};

/// The text of a settings file whose part `outputs` has these.
[[nodiscard]] std::string outputSettings(const OutputSettings& settings);

/// The part `outputs` of a settings file: 1 to 8 of them, with values that are allowed. Errors: io as in readWholeFile,
/// those of FieldsReader, and invalidData at `outputs` where there is none.
[[nodiscard]] Result<OutputSettings> readOutputSettings(const std::filesystem::path& path);

/// How clips are played: what changes at once, while the clip stays as it is.
struct CharacterSettings
{
    static constexpr double leastGain = -40.0, mostGain = 12.0; ///< dB; the least is silence
    static constexpr double mostTransposition = 24.0;           ///< semitones, up and down
    static constexpr double leastSpeed = 0.25, mostSpeed = 4.0;

    double gain = 0.0;          ///< dB
    double intensity = 1.0;     ///< 0 to 1
    double transposition = 0.0; ///< semitones
    double speed = 1.0;         ///< 1: as the clip is
    bool operator==(const CharacterSettings&) const = default;
};

/// The text of a settings file whose part `character` has these.
[[nodiscard]] std::string characterSettings(const CharacterSettings& settings);

/// The part `character` of a settings file; what it does not state is as a new clip has it. Errors: io as in
/// readWholeFile, those of FieldsReader, invalidArgument for values out of their ranges, and invalidData at `character`
/// where there is none.
[[nodiscard]] Result<CharacterSettings> readCharacterSettings(const std::filesystem::path& path);

} // namespace pacini
