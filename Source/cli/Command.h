#pragma once

// Interface of the subcommands of pacini, their factory functions, and the program that runs them.

#include "cli/Console.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <memory>

namespace pacini::cli
{

/// A subcommand: declares its options once, then runs with their values.
class Command
{
public:
    virtual ~Command() = default;

    /// Adds the subcommand and its options to `app`; the returned one is asked whether it was chosen.
    virtual CLI::App* declare(CLI::App& app) = 0;

    /// Does the work. Messages go to the console.
    virtual Exit run(Console& console) = 0;
};

struct BenchOptions;
/// Measures. The program `pacini` starts `pacini-bench` for it, which alone has the code.
using BenchRun = std::function<Exit(const BenchOptions&, Console&)>;

/// The subcommands, each in the source of its name.
[[nodiscard]] std::unique_ptr<Command> encodeCommand();
[[nodiscard]] std::unique_ptr<Command> renderCommand();
[[nodiscard]] std::unique_ptr<Command> infoCommand();
[[nodiscard]] std::unique_ptr<Command> convertCommand();
[[nodiscard]] std::unique_ptr<Command> lintCommand();
[[nodiscard]] std::unique_ptr<Command> profilesCommand();
[[nodiscard]] std::unique_ptr<Command> devicesCommand();
[[nodiscard]] std::unique_ptr<Command> playCommand();
[[nodiscard]] std::unique_ptr<Command> liveCommand();
[[nodiscard]] std::unique_ptr<Command> serveCommand();
[[nodiscard]] std::unique_ptr<Command> compareCommand();
[[nodiscard]] std::unique_ptr<Command> manifestCommand();
[[nodiscard]] std::unique_ptr<Command> measureCommand();
[[nodiscard]] std::unique_ptr<Command> studyCommand();
[[nodiscard]] std::unique_ptr<Command> textureCommand();
[[nodiscard]] std::unique_ptr<Command> plotCommand();
[[nodiscard]] std::unique_ptr<Command> benchCommand(BenchRun run);
[[nodiscard]] std::unique_ptr<Command> helpCommand();
[[nodiscard]] std::unique_ptr<Command> completionsCommand();
[[nodiscard]] std::unique_ptr<Command> manCommand();

/// The steps of `pacini measure`, likewise.
[[nodiscard]] std::unique_ptr<Command> sweepSubcommand();
[[nodiscard]] std::unique_ptr<Command> analyseSubcommand();
[[nodiscard]] std::unique_ptr<Command> fitSubcommand();
[[nodiscard]] std::unique_ptr<Command> verifySubcommand();
[[nodiscard]] std::unique_ptr<Command> simulateSubcommand();
[[nodiscard]] std::unique_ptr<Command> reportSubcommand();
[[nodiscard]] std::unique_ptr<Command> compensateSubcommand();

/// The steps of `pacini study`.
[[nodiscard]] std::unique_ptr<Command> newStudySubcommand();
[[nodiscard]] std::unique_ptr<Command> checkStudySubcommand();
[[nodiscard]] std::unique_ptr<Command> simulateStudySubcommand();
[[nodiscard]] std::unique_ptr<Command> reportStudySubcommand();
[[nodiscard]] std::unique_ptr<Command> profileStudySubcommand();
[[nodiscard]] std::unique_ptr<Command> exportStudySubcommand();
[[nodiscard]] std::unique_ptr<Command> forgetStudySubcommand();
[[nodiscard]] std::unique_ptr<Command> latencyStudySubcommand();

/// The steps of `pacini texture`.
[[nodiscard]] std::unique_ptr<Command> analyseTextureSubcommand();
[[nodiscard]] std::unique_ptr<Command> renderTextureSubcommand();

/// The whole program: parses, runs, returns the exit code. Exceptions of the parser end here. Without `bench`, the
/// program pacini-bench measures.
[[nodiscard]] int runCommandLine(int argc, const char* const* argv, const BenchRun& bench = {});

} // namespace pacini::cli
