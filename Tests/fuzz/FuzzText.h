#pragma once

// What holds for every reader of a text, whatever the bytes.

#include "FuzzCheck.h"

#include <string>
#include <string_view>

namespace pacini
{

/// The bytes as text.
inline std::string_view fuzzedText(const std::uint8_t* data, std::size_t size)
{
    return {reinterpret_cast<const char*>(data), size};
}

/// Whether the reader took the text. It says on one line why not, and every time the same.
template <typename Read>
bool isReadOrRefused(std::string_view text, Read&& read)
{
    const auto result = read(text);
    const auto again = read(text);
    FUZZ_CHECK(result.ok() == again.ok());
    if (result.ok())
        return true;
    FUZZ_CHECK(!result.error().message.empty());
    FUZZ_CHECK(result.error().text().find('\n') == std::string::npos);
    FUZZ_CHECK(result.error().text() == again.error().text());
    return false;
}

} // namespace pacini
