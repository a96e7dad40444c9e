#pragma once

// Bytes of an open file at any place, read in large pieces.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string_view>

namespace pacini
{

/// Reads bytes at any place of a file owned by the caller. Moves the stream's position.
class ByteWindow
{
public:
    static constexpr std::size_t most = 65536; ///< bytes that can be seen at once

    explicit ByteWindow(std::FILE* opened);

    [[nodiscard]] std::uint64_t size() const noexcept { return bytesOfFile; }

    /// The `count` bytes from `offset` on, at most `most`; fewer at the end of the file. Valid until the next call.
    [[nodiscard]] std::span<const unsigned char> at(std::uint64_t offset, std::size_t count);

    /// Whether `text` is at `offset`.
    [[nodiscard]] bool has(std::uint64_t offset, std::string_view text);

    /// The number of `count` bytes at `offset`; 0 where the file has ended.
    [[nodiscard]] std::uint64_t number(std::uint64_t offset, std::size_t count, bool bigEndian);

    /// Returns the next place of `text` in [from, to), or `to`.
    [[nodiscard]] std::uint64_t find(std::string_view text, std::uint64_t from, std::uint64_t to);

private:
    std::FILE* file;
    std::uint64_t bytesOfFile = 0;
    std::uint64_t start = 0;
    std::size_t filled = 0;
    std::array<unsigned char, 2 * most> bytes{};
};

} // namespace pacini
