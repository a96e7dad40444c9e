#pragma once

// Subcommand that runs the benchmarks.

#include "cli/Command.h"
#include "cli/Overwrite.h"
#include "cli/bench/Bench.h"

#include <optional>
#include <string>
#include <vector>

namespace pacini::cli
{

/// `pacini bench`: error against run time, measured on the user's machine and sounds.
class BenchCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    std::string what = "all";
    std::vector<std::string> inputs;
    std::string output = "pacini-bench";
    std::string markdown;
    std::string format = "svg";
    BenchSettings settings;
    OverwriteOptions overwriting;
};

} // namespace pacini::cli
