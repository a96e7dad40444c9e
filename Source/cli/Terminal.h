#pragma once

// Capabilities of the terminal on stderr: redrawing, width.

#include <cstddef>
#include <string>
#include <string_view>

namespace pacini::cli::terminal
{

/// Whether stderr is a terminal on which a line can be drawn again; TERM=dumb says that it cannot.
[[nodiscard]] bool canRedraw();

/// The width of the terminal in characters; 80 when it does not tell.
[[nodiscard]] std::size_t columns();

/// Returns the best width of text lines: that of the terminal, within readable limits.
[[nodiscard]] std::size_t textWidth();

/// The start of the UTF-8 `text` that surely fits into `columns`; characters beyond ASCII count twice, as wide ones do.
[[nodiscard]] std::string cutToWidth(std::string_view text, std::size_t columns);

} // namespace pacini::cli::terminal
