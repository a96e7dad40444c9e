#pragma once

// Character source of the JSON parser: a text in memory or from a stream, with line and column.

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <istream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

class JsonSource
{
public:
    JsonSource(std::string_view text, std::size_t maximumBytes) : limit(maximumBytes)
    {
        take(text);
        passedLimit = text.size() > limit;
    }

    JsonSource(std::istream& stream, std::size_t maximumBytes)
        : input(stream.rdbuf()), buffer(65536), limit(maximumBytes)
    {
    }

    [[nodiscard]] bool atEnd() { return next == end && !refill(); }
    [[nodiscard]] char current() const noexcept { return *next; }
    void advance() noexcept { ++next; }

    /// Characters passed so far.
    [[nodiscard]] std::size_t passed() const noexcept { return chunkStart + passedOfChunk(); }
    /// The text is longer than accepted; it ends at the limit.
    [[nodiscard]] bool tooLong() const noexcept { return passedLimit; }
    /// The last character passed is a NUL, which nlohmann's lexer takes for the end.
    [[nodiscard]] bool endedByNul() const noexcept { return passedOfChunk() > 0 && next[-1] == '\0'; }
    /// Whether what is still to come starts with `text`; sees no further than the current block.
    [[nodiscard]] bool startsWith(std::string_view text)
    {
        return !atEnd() && chunk.substr(passedOfChunk()).starts_with(text);
    }

    /// `line L, column C` of the character before `position`, counted from the start of the text. A lexer looks one
    /// character ahead, so that character may be the last of the block before.
    [[nodiscard]] std::string place(std::size_t position) const
    {
        auto at = lastPlace;
        if (position > chunkStart)
        {
            at = chunkPlace;
            at.pass(chunk.substr(0, position - 1 - chunkStart));
        }
        return fmt::format("line {}, column {}", at.line, at.column);
    }

private:
    struct Place
    {
        std::size_t line = 1;
        std::size_t column = 1; ///< in characters, not bytes

        void pass(std::string_view text) noexcept
        {
            for (char c : text)
            {
                if (c == '\n')
                    *this = {line + 1, 1};
                else if ((static_cast<unsigned char>(c) & 0xC0u) != 0x80u)
                    ++column;
            }
        }
    };

    [[nodiscard]] std::size_t passedOfChunk() const noexcept { return static_cast<std::size_t>(next - chunk.data()); }

    void take(std::string_view text) noexcept
    {
        chunk = text;
        next = text.data();
        end = next + text.size();
    }

    bool refill()
    {
        if (input == nullptr || passedLimit)
            return false;
        if (!chunk.empty())
        {
            lastPlace = chunkPlace;
            lastPlace.pass(chunk.substr(0, chunk.size() - 1));
            chunkPlace.pass(chunk);
        }
        chunkStart += chunk.size();
        const auto got = input->sgetn(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        take({buffer.data(), static_cast<std::size_t>(std::max<std::streamsize>(got, 0))});
        if (chunk.size() > limit - chunkStart)
        {
            passedLimit = true;
            take(chunk.substr(0, limit - chunkStart));
        }
        return !chunk.empty();
    }

    std::streambuf* input = nullptr;
    std::vector<char> buffer;
    std::string_view chunk;
    const char* next = nullptr; ///< in the chunk
    const char* end = nullptr;  ///< of the chunk
    std::size_t chunkStart = 0;
    Place chunkPlace; ///< of the first character of the block
    Place lastPlace;  ///< of the last character of the block before
    std::size_t limit;
    bool passedLimit = false;
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
