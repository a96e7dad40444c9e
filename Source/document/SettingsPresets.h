#pragma once

// Presets of the analysis that the user has saved: settings files (pacini.settings) in a folder.

#include <pacini/analysis/EncoderParams.h>
#include <pacini/foundation/Result.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// One file for each preset, `NAME.json`, which `pacini encode --settings` reads too. All of it [message].
class AnalysisPresets
{
public:
    static constexpr std::size_t longestName = 80; ///< bytes
    static constexpr std::size_t most = 200;       ///< that are listed

    /// The folder need not exist: the first preset makes it.
    explicit AnalysisPresets(std::filesystem::path wanted) : home(std::move(wanted)) {}

    /// The names of all presets, sorted; their files are not read.
    [[nodiscard]] std::vector<std::string> names() const;

    [[nodiscard]] std::filesystem::path pathOf(const std::string& name) const;

    /// Writes a preset as a whole or not at all. Errors: invalidArgument for a name that cannot be one, see
    /// presetNameDefect(); io or diskFull for a file that cannot be written, and for one that is there already unless
    /// it may be replaced.
    [[nodiscard]] Result<void> save(const std::string& name, const EncoderParams& params, bool replace) const;

private:
    std::filesystem::path home;
};

/// The parameters of the analysis in a settings file. Errors: those of readSettingsFile() and translationOf(), and
/// invalidArgument at `method` for another method than a2vt.
[[nodiscard]] Result<EncoderParams> readAnalysisSettings(const std::filesystem::path& path);

} // namespace pacini
