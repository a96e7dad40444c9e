#pragma once

// Command line of `pacini manifest retry`: that of the run before, for the files that failed.

#include <optional>
#include <string>
#include <vector>

namespace pacini::cli
{

/// What to run instead of `words`, all that the user typed: the command and the arguments that the manifest records,
/// with --retry and the further options that were given. Nothing when `words` are another command, or no manifest with
/// a command is named; `manifest retry` itself then says what is wrong.
[[nodiscard]] std::optional<std::vector<std::string>> retriedCommand(const std::vector<std::string>& words);

} // namespace pacini::cli
