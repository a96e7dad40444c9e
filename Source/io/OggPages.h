#pragma once

// Pages of Ogg files (RFC 3533, 6).

#include "io/ByteWindow.h"

#include <cstddef>
#include <cstdint>

namespace pacini
{

inline constexpr std::size_t oggHeaderBytes = 27; ///< of a page, without its table of lengths

/// The bytes of the page at `offset` as its header states them, which may be more than the file has; 0 where there is
/// no header with a whole table.
[[nodiscard]] inline std::uint64_t oggPageBytes(ByteWindow& file, std::uint64_t offset)
{
    if (!file.has(offset, "OggS"))
        return 0;
    const auto head = file.at(offset, oggHeaderBytes + 255);
    if (head.size() < oggHeaderBytes || head.size() < oggHeaderBytes + head[26])
        return 0;
    std::uint64_t bytes = oggHeaderBytes + head[26];
    for (std::size_t i = 0; i < head[26]; ++i)
        bytes += head[oggHeaderBytes + i];
    return bytes;
}

} // namespace pacini
