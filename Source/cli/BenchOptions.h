#pragma once

// Options of `pacini bench`, and the names of its measurements.

#include "cli/Overwrite.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::cli
{

/// The names of allBenches(), in their order.
inline constexpr std::array<std::string_view, 16> benchNames{
    "simplify",   "decimate", "filters", "analysis", "synthesis", "oscillators", "scenes",  "actuators",
    "equalizers", "live",     "body",    "stages",   "methods",   "match",       "runtime", "textures"};

struct BenchSettings
{
    int repeats = 5;    ///< see timed()
    bool sweep = false; ///< also Pacini's own method at many settings
};

/// Values of the options.
struct BenchOptions
{
    std::string what = "all";
    std::vector<std::string> inputs;
    std::string output = "pacini-bench";
    std::string markdown;
    std::string format = "svg";
    BenchSettings settings;
    OverwriteOptions overwriting;
};

} // namespace pacini::cli
