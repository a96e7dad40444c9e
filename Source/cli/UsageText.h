#pragma once

// Error message for a command line that cannot be parsed.

#include <CLI/CLI.hpp>

#include <string>

namespace pacini::cli
{

/// The command that was chosen, such as "measure fit"; empty when none was.
[[nodiscard]] std::string commandPath(const CLI::App& app);

/// One line: what is wrong, what was probably meant, and where to read on.
[[nodiscard]] std::string usageText(const CLI::ParseError& error, const CLI::App& app);

} // namespace pacini::cli
