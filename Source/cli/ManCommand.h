#pragma once

// Subcommand that prints the manual page.

#include "cli/Command.h"

namespace pacini::cli
{

/// `pacini man`: the manual page, made of what the commands declare.
class ManCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    const CLI::App* program = nullptr;
};

} // namespace pacini::cli
