#pragma once

// Runs on the machines of a Ray cluster, by Pacini's package for Python.

#include <pacini/foundation/Result.h>

#include <string>
#include <vector>

namespace pacini::cli
{

/// Replaces this process by Python's pacini.ray, with these arguments. Returns only on failure, with the error: io, or
/// invalidArgument on systems without process replacement.
[[nodiscard]] Error runOnRay(const std::vector<std::string>& arguments);

} // namespace pacini::cli
