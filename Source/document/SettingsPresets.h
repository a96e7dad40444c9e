#pragma once

// Presets that the user has saved, of the analysis, of the outputs and of the live character: settings files
// (pacini.settings) in a folder.

#include "io/PlaybackSettings.h"

#include <pacini/analysis/EncoderParams.h>
#include <pacini/foundation/Result.h>

#include <cstddef>
#include <filesystem>
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

    /// Errors: invalidArgument for a new name that cannot be one or is another preset's, and io.
    [[nodiscard]] Result<void> rename(const std::string& name, const std::string& wanted) const;

    /// Deletes the preset's file. Errors: io.
    [[nodiscard]] Result<void> remove(const std::string& name) const;

    [[nodiscard]] const std::filesystem::path& folder() const noexcept { return home; }

private:
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

/// The part `character` of a settings file; what it does not state is as a new clip has it. Errors: those of
/// readSettingsFile(), and invalidData at `character` where there is none.
[[nodiscard]] Result<CharacterSettings> readCharacterSettings(const std::filesystem::path& path);

} // namespace pacini
