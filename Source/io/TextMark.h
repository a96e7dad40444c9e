#pragma once

// Encoding of text files by their first bytes.

#include "io/Utf8.h"

#include <pacini/foundation/Result.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace pacini
{

/// `bytes` without a byte order mark of UTF-8, which some editors put first. Errors: invalidData for UTF-16 of texts
/// that begin with an ASCII character, as all that are read here do.
[[nodiscard]] inline Result<std::string_view> utf8Text(std::string_view bytes)
{
    using namespace std::string_view_literals;
    const bool hasMark = bytes.starts_with("\xFF\xFE"sv) || bytes.starts_with("\xFE\xFF"sv);
    const bool hasZeroBeside = bytes.size() >= 2 && (bytes[0] == '\0') != (bytes[1] == '\0');
    if (hasMark || (hasZeroBeside && bytes.size() % 2 == 0))
        return Error{ErrorCode::invalidData, "line 1, column 1", "is UTF-16 text; save it as UTF-8"};
    if (bytes.starts_with("\xEF\xBB\xBF"sv))
        bytes.remove_prefix(3);
    return bytes;
}

/// The same of at most `maximumBytes`, else tooLarge.
[[nodiscard]] inline Result<std::string_view> utf8Text(std::string_view bytes, std::size_t maximumBytes)
{
    if (bytes.size() > maximumBytes)
        return Error{ErrorCode::tooLarge, "", "is longer than the longest supported text"};
    return utf8Text(bytes);
}

/// Whether all of a text is UTF-8.
[[nodiscard]] inline bool isUtf8(std::string_view text) noexcept
{
    while (!text.empty())
    {
        const auto bytes = firstUtf8(text).bytes;
        if (bytes == 0)
            return false;
        text.remove_prefix(bytes);
    }
    return true;
}

/// Returns the UTF-8 of a text in Windows-1252, which contains ISO 8859-1 (Latin-1): the encoding of spreadsheets in
/// western Europe.
[[nodiscard]] inline std::string utf8OfWindows1252(std::string_view text)
{
    // Its bytes 0x80 to 0x9F, as the WHATWG encoding standard has them.
    constexpr std::array<char16_t, 32> others{0x20AC, 0x0081, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                              0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0x008D, 0x017D, 0x008F,
                                              0x0090, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                              0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x009D, 0x017E, 0x0178};
    std::string result;
    for (const char c : text)
    {
        const auto byte = static_cast<unsigned char>(c);
        appendUtf8(result, byte >= 0x80 && byte < 0xA0 ? others[byte - 0x80u] : byte);
    }
    return result;
}

/// Returns a short text as UTF-8: as it is, without what ends within a character, or else that of Windows-1252.
[[nodiscard]] inline std::string utf8OfEither(std::string_view text)
{
    if (isUtf8(text))
        return std::string(text);
    constexpr std::size_t longest = 4; // bytes of a character
    for (std::size_t cut = 1; cut < longest && cut < text.size(); ++cut)
    {
        const auto rest = text.substr(0, text.size() - cut);
        const bool isAscii = std::all_of(rest.begin(), rest.end(), [](char c) { return (c & 0x80) == 0; });
        if (!isAscii && isUtf8(rest))
            return std::string(rest);
    }
    return utf8OfWindows1252(text);
}

} // namespace pacini
