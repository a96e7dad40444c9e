#include "io/Json5Text.h"

#include "io/Json5Cursor.h"
#include "io/JsonText.h"
#include "io/TextMark.h"

#include <fmt/format.h>

#include <iterator>

namespace pacini
{

namespace
{
/// Walks through the text once and writes JSON. Every function returns false when it stopped with an error.
class Converter : private json5::Cursor
{
public:
    using Cursor::Cursor;
    using Cursor::error;

    std::string json;

    bool document()
    {
        if (!isUtf8() || !skipSpace() || !value(0) || !skipSpace())
            return false;
        return peek() == json5::endOfText || fail("has text after its end");
    }

private:
    bool value(std::size_t depth)
    {
        const char32_t c = peek();
        if (c == '{' || c == '[')
            return container(depth);
        if (c == '"' || c == '\'')
            return quoted();
        if (c == '+' || c == '-' || c == '.' || json5::isDigit(c) || c == 'I' || c == 'N')
            return number();
        for (const std::string_view word : {"null", "true", "false"})
            if (sees(word))
            {
                pass(word.size());
                json += word;
                return !json5::startsName(peek()) && !json5::isDigit(peek())
                           ? true
                           : fail("is neither a value nor a quoted text");
            }
        return fail(json5::startsName(c) ? "is neither a value nor a quoted text" : "should be a value");
    }

    bool container(std::size_t depth)
    {
        if (depth == deepestJson)
            return fail(position(), "has more than 32 levels of objects and lists", ErrorCode::tooLarge);
        const bool isObject = take() == '{';
        const char32_t close = isObject ? '}' : ']';
        json += isObject ? '{' : '[';
        for (bool first = true;; first = false)
        {
            if (!skipSpace())
                return false;
            if (peek() == close)
                break;
            if (!first)
                json += ',';
            if ((isObject && !(name() && skipSpace() && colon() && skipSpace())) || !value(depth + 1) || !skipSpace())
                return false;
            if (peek() == close)
                break;
            if (peek() != ',')
                return fail(isObject ? "should be a comma or a closing brace"
                                     : "should be a comma or a closing bracket");
            take();
        }
        take();
        json += static_cast<char>(close);
        return true;
    }

    bool colon()
    {
        if (peek() != ':')
            return fail("should be a colon");
        take();
        json += ':';
        return true;
    }

    bool name()
    {
        if (peek() == '"' || peek() == '\'')
            return quoted();
        if (!json5::startsName(peek()))
            return fail("should be a name");
        std::string letters;
        while (json5::startsName(peek()) || json5::isDigit(peek()))
        {
            if (const char32_t c = take(); c != '\\')
                appendUtf8(letters, c);
            else if (peek() != 'u')
                return fail("should be a letter of a name");
            else if (!escape(letters))
                return false;
        }
        put(letters);
        return true;
    }

    bool quoted()
    {
        const char32_t quote = take();
        std::string letters;
        for (;;)
        {
            const char32_t c = peek();
            if (c == '\n' || c == '\r')
                return fail("ends a line inside a text");
            if (c == json5::endOfText)
                return fail("ends too early");
            take();
            if (c == quote)
                break;
            if (c != '\\')
                appendUtf8(letters, c);
            else if (!escape(letters))
                return false;
        }
        put(letters);
        return true;
    }

    void put(const std::string& letters) { appendJsonString(json, letters); }

    bool number()
    {
        constexpr std::size_t longest = 400;
        const std::size_t start = position();
        std::string digits;
        if (peek() == '+' || peek() == '-')
            if (take() == '-')
                digits = '-';
        for (const std::string_view word : {"Infinity", "NaN"})
            if (sees(word))
                return fail(start, fmt::format("{} is not a number in the supported range", word));
        if (sees("0x") || sees("0X"))
            return hexadecimal(start, digits);

        const auto run = [&]
        {
            const std::size_t before = position();
            while (json5::isDigit(peek()))
                digits += static_cast<char>(take());
            return position() - before;
        };
        const std::size_t whole = run();
        if (whole > 1 && digits[digits.size() - whole] == '0')
            return fail(start, "starts with a zero; remove it");
        if (whole == 0)
            digits += '0';
        std::size_t fraction = 0;
        if (peek() == '.')
        {
            take();
            digits += '.';
            fraction = run();
            if (fraction == 0)
                digits += '0';
        }
        if (whole + fraction == 0)
            return fail(start, "is not a number");
        if (peek() == 'e' || peek() == 'E')
        {
            take();
            digits += 'e';
            if (peek() == '+' || peek() == '-')
                digits += static_cast<char>(take());
            if (run() == 0)
                return fail(start, "is not a number");
        }
        if (json5::startsName(peek()) || position() - start > longest)
            return fail(start, "is not a number");
        json += digits;
        return true;
    }

    bool hexadecimal(std::size_t start, const std::string& sign)
    {
        constexpr std::size_t maxDigits = 16;
        pass(2);
        const std::size_t first = position();
        double sum = 0.0;
        for (int digit = json5::hexValue(peek()); digit >= 0; digit = json5::hexValue(peek()))
        {
            sum = 16.0 * sum + digit;
            take();
        }
        if (position() == first || position() - first > maxDigits || json5::startsName(peek()))
            return fail(start, "is not a hexadecimal number of at most 16 digits");
        fmt::format_to(std::back_inserter(json), "{}{}", sign, sum);
        return true;
    }
};
} // namespace

Result<std::string> jsonFromJson5(std::string_view text, std::size_t maximumBytes)
{
    const auto unmarked = utf8Text(text, maximumBytes);
    if (!unmarked)
        return unmarked.error();
    Converter converter(*unmarked);
    if (!converter.document())
        return converter.error;
    return std::move(converter.json);
}

} // namespace pacini
