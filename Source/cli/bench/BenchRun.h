#pragma once

// Run of the benchmarks over sounds.

#include "cli/BenchOptions.h"
#include "cli/Console.h"

namespace pacini::cli
{

/// Measures all sounds, prints the tables and writes the files.
[[nodiscard]] Exit runBenches(const BenchOptions& options, Console& console);

} // namespace pacini::cli
