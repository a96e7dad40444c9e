#pragma once

// Subcommand that prints help.

#include "cli/Command.h"

#include <string>
#include <vector>

namespace pacini::cli
{

/// `pacini help`: what the commands and their options do.
class HelpCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    const CLI::App* program = nullptr;
    std::vector<std::string> topic;
};

} // namespace pacini::cli
