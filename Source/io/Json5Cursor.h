#pragma once

// Character scanner of JSON5 texts: spaces, comments, names, digits and escapes.

#include "io/JsonSource.h"
#include "io/Utf8.h"

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace pacini::json5
{

inline constexpr char32_t endOfText = 0xFFFFFFFF;

[[nodiscard]] inline bool isDigit(char32_t c)
{
    return c >= '0' && c <= '9';
}

[[nodiscard]] inline bool isSpace(char32_t c)
{
    return (c >= '\t' && c <= '\r') || c == ' ' || c == 0xA0 || c == 0x1680 || (c >= 0x2000 && c <= 0x200A) ||
           c == 0x2028 || c == 0x2029 || c == 0x202F || c == 0x205F || c == 0x3000 || c == 0xFEFF;
}

[[nodiscard]] inline bool endsLine(char32_t c)
{
    return c == '\n' || c == '\r' || c == 0x2028 || c == 0x2029;
}

/// Names may hold any character beyond ASCII that is no space: which of them are letters would need Unicode's tables.
[[nodiscard]] inline bool startsName(char32_t c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '$' || c == '_' || c == '\\' ||
           (c >= 0x80 && c != endOfText && !isSpace(c));
}

[[nodiscard]] inline int hexValue(char32_t c)
{
    if (isDigit(c))
        return static_cast<int>(c - '0');
    const char32_t lower = c | 0x20u;
    return c < 0x80 && lower >= 'a' && lower <= 'f' ? static_cast<int>(lower - 'a' + 10) : -1;
}

/// A position in a JSON5 text. Functions that fail set `error` and return false.
class Cursor
{
public:
    explicit Cursor(std::string_view json5) : text(json5), source(json5) {}

    Error error;

    /// Checks that the whole text is UTF-8, which the rest relies on.
    bool isUtf8()
    {
        for (std::size_t i = 0; i < text.size();)
        {
            const auto character = firstUtf8(text.substr(i));
            if (character.bytes == 0)
                return fail(i, "is not UTF-8");
            i += character.bytes;
        }
        return true;
    }

    /// Bytes passed so far.
    [[nodiscard]] std::size_t position() const noexcept { return at; }

    /// Whether `word` comes next.
    [[nodiscard]] bool sees(std::string_view word) const noexcept { return text.substr(at).starts_with(word); }

    void pass(std::size_t bytes) noexcept { at += bytes; }

    [[nodiscard]] char32_t peek() const { return at < text.size() ? firstUtf8(text.substr(at)).code : endOfText; }

    char32_t take()
    {
        const auto character = firstUtf8(text.substr(at));
        at += character.bytes;
        return character.code;
    }

    bool fail(std::size_t byte, std::string message, ErrorCode code = ErrorCode::invalidData)
    {
        error = {code, source.place(byte + 1), std::move(message)};
        return false;
    }
    bool fail(std::string message) { return fail(at, at < text.size() ? std::move(message) : "ends too early"); }

    bool skipSpace()
    {
        for (;;)
        {
            const std::size_t start = at;
            if (sees("//"))
                while (peek() != endOfText && !endsLine(peek()))
                    take();
            else if (sees("/*"))
            {
                const auto end = text.find("*/", at + 2);
                if (end == std::string_view::npos)
                    return fail(start, "opens a comment that does not end");
                at = end + 2;
            }
            else if (isSpace(peek()))
                take();
            else
                return true;
        }
    }

    /// Reads the rest of an escape sequence, after the backslash.
    bool escape(std::string& letters)
    {
        const std::size_t start = at;
        if (peek() == endOfText)
            return fail("ends too early");
        const char32_t c = take();
        switch (c)
        {
        case 'b':
            letters += '\b';
            return true;
        case 'f':
            letters += '\f';
            return true;
        case 'n':
            letters += '\n';
            return true;
        case 'r':
            letters += '\r';
            return true;
        case 't':
            letters += '\t';
            return true;
        case 'v':
            letters += '\v';
            return true;
        case 'x':
            return codePoint(letters, 2, start);
        case 'u':
            return codePoint(letters, 4, start);
        case '\r': // the text goes on in the next line
            if (peek() == '\n')
                take();
            return true;
        case '\n':
        case 0x2028:
        case 0x2029:
            return true;
        default:
            break;
        }
        if (c == '0' && !isDigit(peek()))
            letters += '\0';
        else if (isDigit(c))
            return fail(start, "is not a valid escape; write \\x and two digits");
        else
            appendUtf8(letters, c);
        return true;
    }

private:
    bool codePoint(std::string& letters, int digits, std::size_t start)
    {
        constexpr char32_t none = ~char32_t{0};
        const auto read = [&]
        {
            char32_t code = 0;
            for (int i = 0; i < digits; ++i)
            {
                const int digit = hexValue(peek());
                if (digit < 0)
                    return none;
                code = 16 * code + static_cast<char32_t>(digit);
                take();
            }
            return code;
        };
        char32_t code = read();
        if (code >= 0xD800 && code < 0xDC00 && sees("\\u"))
        {
            at += 2;
            const char32_t low = read();
            code = low >= 0xDC00 && low < 0xE000 ? 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00) : none;
        }
        if (code == none || (code >= 0xD800 && code < 0xE000))
            return fail(start, "is not a valid escape of a character");
        appendUtf8(letters, code);
        return true;
    }

    std::string_view text;
    JsonSource source;
    std::size_t at = 0;
};

} // namespace pacini::json5
