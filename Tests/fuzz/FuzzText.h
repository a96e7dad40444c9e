#pragma once

// What holds for every reader of a text, whatever the bytes.

#include "FuzzCheck.h"

#include <pacini/foundation/Result.h>

#include <string>
#include <string_view>

namespace pacini
{

/// The bytes as text.
inline std::string_view fuzzedText(const std::uint8_t* data, std::size_t size)
{
    return {reinterpret_cast<const char*>(data), size};
}

/// Returns 0, as a target does, after a check that `error` says on one line what is wrong.
inline int refused(const Error& error)
{
    FUZZ_CHECK(!error.message.empty());
    FUZZ_CHECK(error.text().find('\n') == std::string::npos);
    return 0;
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
    refused(result.error());
    FUZZ_CHECK(result.error().text() == again.error().text());
    return false;
}

/// A whole target: the reader takes or refuses the bytes; check(value, text) follows with what it took.
template <typename Read, typename Check>
int fuzzReader(const std::uint8_t* data, std::size_t size, Read&& read, Check&& check)
{
    const std::string_view text = fuzzedText(data, size);
    if (isReadOrRefused(text, read))
        check(*read(text), text);
    return 0;
}

} // namespace pacini
