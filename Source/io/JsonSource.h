#pragma once

// Character source of the JSON parser: a text with line and column.

#include <fmt/format.h>

#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>

namespace pacini
{

class JsonSource
{
public:
    explicit JsonSource(std::string_view wholeText) : text(wholeText) {}

    [[nodiscard]] bool atEnd() const noexcept { return next == text.size(); }
    [[nodiscard]] char current() const noexcept { return text[next]; }
    void advance() noexcept { ++next; }

    /// Characters passed so far.
    [[nodiscard]] std::size_t passed() const noexcept { return next; }
    /// The last character passed is a NUL, which nlohmann's lexer takes for the end.
    [[nodiscard]] bool endedByNul() const noexcept { return next > 0 && text[next - 1] == '\0'; }
    /// Whether the remaining text starts with `start`.
    [[nodiscard]] bool startsWith(std::string_view start) const { return text.substr(next).starts_with(start); }

    /// `line L, column C` of the character before `position`, counted from the start of the text; columns count
    /// characters, not bytes.
    [[nodiscard]] std::string place(std::size_t position) const
    {
        std::size_t line = 1, column = 1;
        for (const char c : text.substr(0, position > 0 ? position - 1 : 0))
        {
            if (c == '\n')
            {
                ++line;
                column = 1;
            }
            else if ((static_cast<unsigned char>(c) & 0xC0u) != 0x80u)
                ++column;
        }
        return fmt::format("line {}, column {}", line, column);
    }

private:
    std::string_view text;
    std::size_t next = 0;
};

/// A JsonSource as a pair of input iterators: Cursor(source) to Cursor().
class JsonCursor
{
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = char;

    JsonCursor() = default;
    explicit JsonCursor(JsonSource& textSource) noexcept : source(&textSource) {}

    char operator*() const noexcept { return source->current(); }
    JsonCursor& operator++() noexcept
    {
        source->advance();
        return *this;
    }
    JsonCursor operator++(int) noexcept
    {
        const auto before = *this;
        source->advance();
        return before;
    }
    /// Only the comparison of a place with the end is asked for.
    bool operator==(const JsonCursor&) const { return source->atEnd(); }

private:
    JsonSource* source = nullptr;
};

} // namespace pacini
