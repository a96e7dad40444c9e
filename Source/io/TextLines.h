#pragma once

// Lines of a text, whatever system wrote it.

#include <optional>
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

/// Takes the line by which a table tells spreadsheets its separator, such as `sep=;`, off the front of `text`: that
/// separator; none where there is no such line.
[[nodiscard]] constexpr std::optional<char> takeSeparatorLine(std::string_view& text)
{
    std::string_view rest = text;
    if (!text.starts_with("sep="))
        return std::nullopt;
    const std::string_view line = takeLine(rest);
    if (line.size() != 5)
        return std::nullopt;
    text = rest;
    return line.back();
}

/// `text` without the blanks, tabs and carriage returns around it.
[[nodiscard]] constexpr std::string_view withoutBlanks(std::string_view text)
{
    constexpr std::string_view blanks = " \t\r";
    const auto first = text.find_first_not_of(blanks);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

} // namespace pacini
