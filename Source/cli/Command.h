#pragma once

// Interface of the subcommands of pacini, their list, and the program that runs them.

#include "cli/Console.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <vector>

namespace pacini::cli
{

/// A subcommand: declares its options once, then runs with what the user gave.
class Command
{
public:
    virtual ~Command() = default;

    /// Adds the subcommand and its options to `app`; the returned one is asked whether it was chosen.
    virtual CLI::App* declare(CLI::App& app) = 0;

    /// Does the work. Messages go to the console.
    virtual Exit run(Console& console) = 0;
};

/// All subcommands in the order of the help text.
[[nodiscard]] std::vector<std::unique_ptr<Command>> allCommands();

/// The whole program: parses, runs, returns the exit code. Exceptions of the parser end here.
[[nodiscard]] int runCommandLine(int argc, const char* const* argv);

} // namespace pacini::cli
