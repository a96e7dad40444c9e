#pragma once

// Error message for a command line that cannot be parsed.

#include <CLI/CLI.hpp>

#include <string>

namespace pacini::cli
{

/// The chosen command, such as "measure fit"; empty if none was given.
[[nodiscard]] std::string commandPath(const CLI::App& app);

/// Returns one line: the error, the probably intended word, and the help to read.
[[nodiscard]] std::string usageText(const CLI::ParseError& error, const CLI::App& app);

} // namespace pacini::cli
