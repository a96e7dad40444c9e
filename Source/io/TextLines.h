#pragma once

// Lines of a text, whatever system wrote it.

#include <string_view>

namespace pacini
{

/// Takes the first line off `text`, which is not empty. Lines end with \n, \r\n or \r.
[[nodiscard]] constexpr std::string_view takeLine(std::string_view& text)
{
    const auto end = text.find_first_of("\r\n");
    const std::string_view line = text.substr(0, end);
    const std::string_view rest = end == std::string_view::npos ? std::string_view() : text.substr(end);
    text = rest.substr(rest.empty() ? 0 : rest.starts_with("\r\n") ? 2 : 1);
    return line;
}

} // namespace pacini
