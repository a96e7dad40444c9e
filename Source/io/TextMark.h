#pragma once

// Encoding of text files by their first bytes.

#include <pacini/foundation/Result.h>

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

} // namespace pacini
