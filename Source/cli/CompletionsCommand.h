#pragma once

// Subcommand that prints shell completions.

#include "cli/Command.h"

#include <string>

namespace pacini::cli
{

/// `pacini completions`: what a shell needs to complete commands, options and their values.
class CompletionsCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    const CLI::App* program = nullptr;
    std::string shell;
};

} // namespace pacini::cli
