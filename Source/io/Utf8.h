#pragma once

// UTF-8 decoder and encoder (RFC 3629).

#include <cstddef>
#include <string>
#include <string_view>

namespace pacini
{

/// The character at the start of a text.
struct Utf8Character
{
    char32_t code = 0;
    std::size_t bytes = 0; ///< 0 when the text does not start with a well-formed character
};

/// Decodes the first character of `text`: overlong forms, surrogates and what is beyond U+10FFFF are ill-formed.
[[nodiscard]] constexpr Utf8Character firstUtf8(std::string_view text) noexcept
{
    if (text.empty())
        return {};
    const auto byte = [&](std::size_t i)
    {
        return static_cast<unsigned char>(text[i]);
    };
    const unsigned lead = byte(0);
    if (lead < 0x80)
        return {lead, 1};
    const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes)
        return {};
    char32_t code = lead & (0x7Fu >> bytes);
    for (std::size_t i = 1; i < bytes; ++i)
    {
        if ((byte(i) & 0xC0u) != 0x80u)
            return {};
        code = (code << 6) | (byte(i) & 0x3Fu);
    }
    const bool overlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
    const bool outside = (code >= 0xD800 && code <= 0xDFFF) || code > 0x10FFFF;
    return overlong || outside ? Utf8Character{} : Utf8Character{code, bytes};
}

/// Appends a character, which must not be a surrogate.
inline void appendUtf8(std::string& text, char32_t code)
{
    const auto put = [&](char32_t bits)
    {
        text += static_cast<char>(static_cast<unsigned char>(bits));
    };
    if (code < 0x80)
        return put(code);
    if (code < 0x800)
        put(0xC0u | (code >> 6));
    else
    {
        if (code < 0x10000)
            put(0xE0u | (code >> 12));
        else
        {
            put(0xF0u | (code >> 18));
            put(0x80u | ((code >> 12) & 0x3Fu));
        }
        put(0x80u | ((code >> 6) & 0x3Fu));
    }
    put(0x80u | (code & 0x3Fu));
}

/// `text` with U+FFFD for every byte that starts no well-formed character.
[[nodiscard]] inline std::string wellFormedUtf8(std::string_view text)
{
    std::string result;
    while (!text.empty())
    {
        const auto bytes = firstUtf8(text).bytes;
        if (bytes > 0)
            result += text.substr(0, bytes);
        else
            appendUtf8(result, 0xFFFD);
        text.remove_prefix(bytes > 0 ? bytes : 1);
    }
    return result;
}

} // namespace pacini
