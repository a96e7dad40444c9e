#pragma once

// Help text, as `pacini help` and --help print it.

#include "cli/CommandTree.h"

#include <cstddef>
#include <string>

namespace pacini::cli
{

/// All about a command, in lines of at most `width` characters, except for examples; without the last line's end.
[[nodiscard]] std::string helpText(const CommandText& command, std::size_t width);

/// The commands of the program and where to read on, in a few lines.
[[nodiscard]] std::string shortHelp(const CommandText& program);

} // namespace pacini::cli
