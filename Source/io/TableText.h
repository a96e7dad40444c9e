#pragma once

// Escaping of text for fields of tables and for XML.

#include <string>
#include <string_view>

namespace pacini
{

/// `text` as a field of a CSV table (RFC 4180): in quotes where it needs them, also for readers that part fields by ;.
[[nodiscard]] inline std::string csvField(std::string_view text)
{
    if (text.find_first_of(",;\"\r\n") == std::string_view::npos)
        return std::string(text);
    std::string quoted = "\"";
    for (const char c : text)
        quoted.append(c == '"' ? 2 : 1, c);
    return quoted + '"';
}

/// `text` as content or attribute of XML and HTML.
[[nodiscard]] inline std::string xmlText(std::string_view text)
{
    std::string safe;
    for (const char c : text)
        switch (c)
        {
        case '&':
            safe += "&amp;";
            break;
        case '<':
            safe += "&lt;";
            break;
        case '>':
            safe += "&gt;";
            break;
        case '"':
            safe += "&quot;";
            break;
        default:
            safe += c;
        }
    return safe;
}

} // namespace pacini
