#include "io/SoundTags.h"

#include <charconv>
#include <string_view>

namespace pacini
{

// Sources: M. Nilsson, "ID3 tag version 2.4.0 - Main Structure", 2000; "ID3v1", id3.org, 1996; "APEv2 specification",
// Hydrogenaudio, 2004; P. Strnad, "Lyrics3 Tag v2.00", 1998.

namespace
{
constexpr std::uint64_t id3v1Bytes = 128;
constexpr std::uint64_t apeHeaderBytes = 32;

/// What a Lyrics3 tag of version 2 says of itself in the six digits before its end mark: bytes without both.
std::uint64_t lyricsBytes(ByteWindow& file, std::uint64_t digits)
{
    const auto found = file.at(digits, 6);
    const std::string_view text(reinterpret_cast<const char*>(found.data()), found.size());
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return text.size() == 6 && error == std::errc() && end == text.data() + 6 ? value : 0;
}

/// The bytes of the APE tag whose footer ends at `end`. Whether it has a header and how long it is are looked at: what
/// a footer claims wrongly would be taken from the sound.
std::uint64_t apeBytesBefore(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    constexpr std::string_view mark = "APETAGEX";
    constexpr std::uint64_t itemHead = 8; // bytes: size of the value, flags; its key and a zero follow
    const auto size = file.number(end - 20, 4, false);
    if (size < apeHeaderBytes || size > end - begin)
        return apeHeaderBytes;
    const auto items = end - size;
    if (items - begin >= apeHeaderBytes && file.has(items - apeHeaderBytes, mark))
        return size + apeHeaderBytes;
    if (size == apeHeaderBytes || file.has(items, mark)) // by writers that count the header
        return size;
    const auto key = file.number(items + itemHead, 2, true);
    const bool isKey = key >> 8u >= 0x20 && key >> 8u < 0x7F && (key & 0xFFu) >= 0x20 && (key & 0xFFu) < 0x7F;
    return isKey && file.number(items, 4, false) <= size - apeHeaderBytes ? size : apeHeaderBytes;
}

/// The bytes of the tag that ends at `end`, or 0.
std::uint64_t tagBytesBefore(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    const auto room = end - begin;
    if (room >= id3v1Bytes && file.has(end - id3v1Bytes, "TAG"))
        return id3v1Bytes;
    if (room >= apeHeaderBytes && file.has(end - apeHeaderBytes, "APETAGEX"))
        return apeBytesBefore(file, begin, end);
    if (room >= 15 && file.has(end - 9, "LYRICS200"))
        return lyricsBytes(file, end - 15) + 15;
    if (room >= 9 && file.has(end - 9, "LYRICSEND"))
    {
        constexpr std::uint64_t mostOfVersion1 = 5100;
        const auto from = room > mostOfVersion1 ? end - mostOfVersion1 : begin;
        return end - file.find("LYRICSBEGIN", from, end);
    }
    if (room >= 10 && file.has(end - 10, "3DI"))
    {
        const auto size = file.at(end - 4, 4);
        return 20 + ((size[0] & 0x7Fu) << 21u | (size[1] & 0x7Fu) << 14u | (size[2] & 0x7Fu) << 7u | (size[3] & 0x7Fu));
    }
    return 0;
}
} // namespace

std::uint64_t tagBytesAt(ByteWindow& file, std::uint64_t offset)
{
    if (file.has(offset, "ID3"))
    {
        const auto head = file.at(offset, 10);
        if (head.size() < 10 || head[3] == 0xFF || head[4] == 0xFF)
            return 0;
        constexpr unsigned hasFooter = 0x10;
        return (head[5] & hasFooter ? 20u : 10u) +
               ((head[6] & 0x7Fu) << 21u | (head[7] & 0x7Fu) << 14u | (head[8] & 0x7Fu) << 7u | (head[9] & 0x7Fu));
    }
    if (file.has(offset, "TAG"))
        return id3v1Bytes;
    if (file.has(offset, "APETAGEX"))
        return file.number(offset + 12, 4, false) + apeHeaderBytes;
    if (file.has(offset, "LYRICSBEGIN"))
    {
        constexpr std::uint64_t mostOfVersion2 = 1'000'000;
        const auto last = offset + mostOfVersion2;
        const auto end = file.find("LYRICS200", offset, last < file.size() ? last : file.size());
        return end < last && file.has(end, "LYRICS200") ? end + 9 - offset : 0;
    }
    return 0;
}

std::uint64_t endBeforeTags(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    for (;;)
    {
        const auto bytes = tagBytesBefore(file, begin, end);
        if (bytes == 0 || bytes > end - begin)
            return end;
        end -= bytes;
    }
}

} // namespace pacini
