#pragma once

// Location of the running program, beside which its profiles are looked for.

#include <filesystem>

namespace pacini::cli
{

/// Returns the folder of the running program; the current folder if the system does not state it.
[[nodiscard]] std::filesystem::path programFolder();

} // namespace pacini::cli
