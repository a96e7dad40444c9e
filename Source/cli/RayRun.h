#pragma once

// Runs on the machines of a Ray cluster, by Pacini's package for Python.

#include <pacini/foundation/Result.h>

#include <string>
#include <vector>

namespace pacini::cli
{

/// Lets Python's pacini.ray take the place of this program, with these arguments. Comes back only with the error that
/// kept it from that: io, or invalidArgument where a program cannot be replaced.
[[nodiscard]] Error runOnRay(const std::vector<std::string>& arguments);

} // namespace pacini::cli
