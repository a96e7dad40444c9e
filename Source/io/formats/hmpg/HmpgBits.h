#pragma once

// Bits of an HMPG file, most significant first.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pacini
{

class HmpgBitWriter
{
public:
    /// The lowest `count` bits of `value`, 0 to 64.
    void put(std::uint64_t value, int count)
    {
        for (int i = count - 1; i >= 0; --i)
        {
            if (used == 0)
                text += '\0';
            const auto bit = static_cast<unsigned>((value >> i) & 1u);
            text.back() = static_cast<char>(static_cast<unsigned char>(text.back()) | (bit << (7 - used)));
            used = (used + 1) % 8;
        }
    }

    /// Its length in 8 bits, and its bytes: 255 or fewer.
    void putText(std::string_view words)
    {
        put(words.size(), 8);
        for (const char c : words)
            put(static_cast<unsigned char>(c), 8);
    }

    /// All bytes, the last one filled up with 0.
    [[nodiscard]] const std::string& bytes() const { return text; }

private:
    std::string text;
    int used = 0; ///< bits of the last byte
};

/// Reads from bytes that outlive it. After the end, `failed` and all bits are 0.
class HmpgBitReader
{
public:
    explicit HmpgBitReader(std::string_view bytesToRead) : bytes(bytesToRead) {}

    /// The next `count` bits, 0 to 64.
    std::uint64_t take(int count)
    {
        std::uint64_t value = 0;
        for (int i = 0; i < count; ++i, ++place)
        {
            if (place / 8 >= bytes.size())
                hasFailed = true;
            else
                value |= ((static_cast<unsigned char>(bytes[place / 8]) >> (7 - place % 8)) & std::uint64_t{1})
                         << (count - 1 - i);
        }
        return value;
    }

    /// The same as a number with a sign, in two's complement.
    std::int64_t takeSigned(int count)
    {
        const std::uint64_t value = take(count);
        return static_cast<std::int64_t>(value << (64 - count)) >> (64 - count);
    }

    /// Passes over `count` bits.
    void skip(std::uint64_t count)
    {
        place += static_cast<std::size_t>(count);
        hasFailed = hasFailed || place / 8 + (place % 8 != 0 ? 1 : 0) > bytes.size();
    }

    /// Passes over a text as HmpgBitWriter::putText() writes it.
    void skipText() { skip(8 * take(8)); }

    /// As HmpgBitWriter::putText() writes it.
    std::string takeText() { return takeBytes(take(8)); }

    /// As many bytes as there are of `count`.
    std::string takeBytes(std::uint64_t count)
    {
        std::string words;
        for (std::uint64_t i = 0; i < count && !hasFailed; ++i)
            words += static_cast<char>(take(8));
        return words;
    }

    /// Bytes behind the one that was taken last.
    [[nodiscard]] std::size_t wholeBytesLeft() const { return hasFailed ? 0 : bytes.size() - (place + 7) / 8; }

    /// Whether more was taken than there is.
    [[nodiscard]] bool failed() const { return hasFailed; }

private:
    std::string_view bytes;
    std::size_t place = 0; ///< bits
    bool hasFailed = false;
};

} // namespace pacini
