#pragma once

// Subcommand that converts clips and profiles between formats.

#include "cli/Command.h"
#include "cli/ConvertJob.h"
#include "cli/ExportOptions.h"
#include "cli/InputFiles.h"
#include "cli/Overwrite.h"

#include <optional>
#include <string>
#include <vector>

namespace pacini::cli
{

/// `pacini convert`: clips, or profiles, of one format become another.
class ConvertCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    Exit convertProfile(Console& console);
    Exit convertClips(Console& console);

    /// What may be replaced at a file that the user named: the last of the files may be there by mistake.
    [[nodiscard]] Replaceable replaceable() const noexcept { return overwriting.of(byName); }

    /// Whether output would overwrite the only input, which is said.
    bool overwritesInput(Console& console) const;

    /// What to convert to; nothing when the options do not say, and the console has said why.
    [[nodiscard]] std::optional<ConvertSettings> settingsFor(Console& console, bool several) const;

    /// The clips to convert, without second files of a clip.
    [[nodiscard]] InputFiles findClips() const;

    std::vector<std::string> inputs;
    std::string output;
    std::string format;
    ExportOptions options;
    std::string manifest;
    int quantise = 0;
    unsigned jobs = 0;
    bool force = false;
    OverwriteOptions overwriting;
    bool byName = true; ///< the output was named with -o
    bool dryRun = false;
};

} // namespace pacini::cli
