#pragma once

// Command line of `pacini manifest retry`: that of the earlier run, for the files that failed.

#include <optional>
#include <string>
#include <vector>

namespace pacini::cli
{

/// Returns the command line to run instead of `words`, the one typed: the recorded command and arguments of the
/// manifest, with --retry and the further given options. None if `words` are another command, or name no manifest with
/// a command; `manifest retry` itself then reports the error.
[[nodiscard]] std::optional<std::vector<std::string>> retriedCommand(const std::vector<std::string>& words);

} // namespace pacini::cli
