#pragma once

#include "cli/Command.h"
#include "cli/ExportOptions.h"

#include <string>
#include <vector>

namespace pacini::cli
{

/// `pacini lint`: what a format will lose of clips, before anything is written.
class LintCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    /// Whether a loss is more than the user allows.
    [[nodiscard]] bool isTooMuch(const FormatLoss& loss) const;

    std::vector<std::string> inputs;
    std::string target;
    ExportOptions options;
    double maxError = -1.0; ///< negative: any
    double maxOctaves = -1.0;
    double maxTime = -1.0;
    std::vector<std::string> forbidden;
    bool listTargets = false;
};

} // namespace pacini::cli
