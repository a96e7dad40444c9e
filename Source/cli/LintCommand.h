#pragma once

// Subcommand that checks clips and scenes.

#include "cli/Command.h"
#include "cli/ExportOptions.h"
#include "cli/InputFiles.h"

#include <pacini/synthesis/Scene.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::cli
{

/// `pacini lint`: what a format will lose of clips, before anything is written, and what in a scene does nothing.
class LintCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    /// Whether the user does not allow anything of this kind.
    [[nodiscard]] bool failsOn(std::string_view kind) const;

    /// Whether a loss is more than the user allows.
    [[nodiscard]] bool isTooMuch(const FormatLoss& loss) const;

    /// What is in the report of a file; each also prints it, and counts what is too much.
    using Json = nlohmann::ordered_json;
    [[nodiscard]] Result<Json> lint(Console& console, const InputFile& file, const ExportParams& params,
                                    std::size_t& tooMuch) const;
    [[nodiscard]] Json lintScene(Console& console, const std::string& name, const Scene& scene,
                                 std::size_t& tooMuch) const;
    [[nodiscard]] Result<Json> lintClip(Console& console, const std::string& name, const Clip& clip,
                                        const ExportParams& params, std::size_t& tooMuch) const;

    std::vector<std::string> inputs;
    std::string target;
    std::string clipFolder;
    ExportOptions options;
    double maxError = -1.0; ///< negative: any
    double maxOctaves = -1.0;
    double maxTime = -1.0;
    std::vector<std::string> forbidden;
    bool listTargets = false;
};

} // namespace pacini::cli
