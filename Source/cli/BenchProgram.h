#pragma once

// Start of the program that has the benchmarks.

#include "cli/Console.h"

#include <string>
#include <vector>

namespace pacini::cli
{

/// Replaces this process by pacini-bench, from the folder of this program, with the command line `words`. Fails if
/// there is no such program.
[[nodiscard]] Exit runBenchProgram(const std::vector<std::string>& words, Console& console);

} // namespace pacini::cli
