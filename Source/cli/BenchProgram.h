#pragma once

// Start of the program that has the benchmarks.

#include "cli/Console.h"

#include <string>
#include <vector>

namespace pacini::cli
{

/// Runs pacini-bench, beside this program, in its place, with `words`, all that the user typed. Fails where there is no
/// such program.
[[nodiscard]] Exit runBenchProgram(const std::vector<std::string>& words, Console& console);

} // namespace pacini::cli
