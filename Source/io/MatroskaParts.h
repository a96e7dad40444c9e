#pragma once

// Parts of a Matroska or WebM file that players pass over without a word.

#include <cstdint>
#include <cstdio>

namespace pacini
{

/// Bytes of the file, from `begin` on, in which nothing lies that Matroska has: a part whose id is damaged is passed
/// over with all that is in it, and what cannot be told apart up to the end of the file. 0 for other files, and where
/// there are too many parts to look at. What is cut off is not counted. Moves the stream's position; trusts no number.
/// Source: RFC 8794 and RFC 9559.
[[nodiscard]] std::uint64_t unknownBytesOfMatroska(std::FILE* opened, std::uint64_t begin = 0);

} // namespace pacini
