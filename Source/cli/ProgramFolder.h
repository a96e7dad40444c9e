#pragma once

// Location of the running program, beside which its profiles are looked for.

#include <filesystem>

namespace pacini::cli
{

/// The folder that the running program lies in; the current one where the system does not tell.
[[nodiscard]] std::filesystem::path programFolder();

} // namespace pacini::cli
