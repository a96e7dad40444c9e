#include "io/Id3Chapters.h"

#include "io/Utf8.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace pacini
{

namespace
{
constexpr std::size_t id3HeaderBytes = 10; // of a tag, and of a frame

std::uint32_t id3ByteAt(std::string_view bytes, std::size_t place)
{
    return static_cast<unsigned char>(bytes[place]);
}

/// The number of 32 bits at `place`; with 7 bits of each byte where `bits` is 7.
std::uint32_t id3NumberAt(std::string_view bytes, std::size_t place, unsigned bits = 8)
{
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << bits | (id3ByteAt(bytes, place + i) & (bits == 7 ? 0x7Fu : 0xFFu));
    return value;
}

/// Bytes without the zeros that writers put behind 0xFF so that players take none for sound.
std::string resynchronised(std::string_view bytes)
{
    std::string result;
    for (std::size_t i = 0; i < bytes.size(); ++i)
    {
        result += bytes[i];
        if (id3ByteAt(bytes, i) == 0xFF && i + 1 < bytes.size() && bytes[i + 1] == '\0')
            ++i;
    }
    return result;
}

/// Whether a frame's name, padding or the end is at `place`.
bool endsId3Frame(std::string_view bytes, std::size_t place)
{
    if (place >= bytes.size())
        return place == bytes.size();
    const auto name = bytes.substr(place, 4);
    return name.front() == '\0' || std::all_of(name.begin(), name.end(),
                                               [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); });
}

struct Id3Frame
{
    std::string_view name;
    std::optional<std::string> content; ///< none where it is compressed or encrypted
    std::size_t bytes = 0;              ///< with its header
};

/// The frame at the beginning of `frames`; nothing where there is none or it does not fit.
std::optional<Id3Frame> firstId3Frame(std::string_view frames, unsigned version)
{
    if (frames.size() < id3HeaderBytes || frames.front() == '\0' || !endsId3Frame(frames, 0))
        return {};
    // Version 2.4 counts in bytes of 7 bits. Some programs do so in 2.3, and do not in 2.4.
    const unsigned bits = version == 4 ? 7 : 8;
    auto size = std::size_t(id3NumberAt(frames, 4, bits));
    if (!endsId3Frame(frames, id3HeaderBytes + size))
        if (const auto other = std::size_t(id3NumberAt(frames, 4, 15 - bits));
            endsId3Frame(frames, id3HeaderBytes + other))
            size = other;
    if (size > frames.size() - id3HeaderBytes)
        return {};
    Id3Frame frame{frames.substr(0, 4), std::nullopt, id3HeaderBytes + size};
    const auto flags = id3ByteAt(frames, 9);
    auto content = frames.substr(id3HeaderBytes, size);
    const unsigned packed = version == 4 ? 0x0C : 0xC0;
    const unsigned grouped = version == 4 ? 0x40 : 0x20;
    const std::size_t before = (flags & grouped ? 1u : 0u) + (version == 4 && flags & 1u ? 4u : 0u);
    if ((flags & packed) != 0 || before > content.size())
        return frame;
    content.remove_prefix(before);
    frame.content = version == 4 && (flags & 2u) != 0 ? resynchronised(content) : std::string(content);
    return frame;
}

/// A text of UTF-16 up to its first zero.
std::string utf16Text(std::string_view bytes, bool bigEndian)
{
    const auto unitAt = [&](std::size_t i) -> char32_t
    {
        if (i + 1 >= bytes.size())
            return 0;
        return id3ByteAt(bytes, i + (bigEndian ? 0 : 1)) << 8u | id3ByteAt(bytes, i + (bigEndian ? 1 : 0));
    };
    std::string text;
    for (std::size_t i = 0; unitAt(i) != 0; i += 2)
    {
        const auto unit = unitAt(i), next = unitAt(i + 2);
        const bool isSurrogate = unit >= 0xD800 && unit < 0xE000;
        const bool isPair = unit >= 0xD800 && unit < 0xDC00 && next >= 0xDC00 && next < 0xE000;
        appendUtf8(text, isPair ? 0x10000 + ((unit - 0xD800) << 10u) + (next - 0xDC00) : isSurrogate ? 0xFFFD : unit);
        i += isPair ? 2 : 0;
    }
    return text;
}

/// What a frame of text holds, as UTF-8.
std::string id3TextOf(std::string_view content)
{
    if (content.empty())
        return {};
    const auto encoding = id3ByteAt(content, 0);
    content.remove_prefix(1);
    if (encoding == 1 || encoding == 2)
    {
        const bool isMarked =
            content.size() >= 2 && (content.starts_with("\xFE\xFF") || content.starts_with("\xFF\xFE"));
        const bool bigEndian = isMarked ? content.starts_with("\xFE\xFF") : encoding == 2;
        return utf16Text(content.substr(isMarked ? 2 : 0), bigEndian);
    }
    content = content.substr(0, content.find('\0'));
    if (encoding == 3)
        return wellFormedUtf8(content);
    std::string text;
    for (std::size_t i = 0; i < content.size(); ++i)
        appendUtf8(text, id3ByteAt(content, i));
    return text;
}

/// The chapter that a CHAP frame holds: its name, a zero, four numbers, of which the first is its start in ms, and
/// frames of its own.
std::optional<Marker> chapterOf(std::string_view content, unsigned version)
{
    const auto zero = content.find('\0');
    if (zero == std::string_view::npos || content.size() - zero - 1 < 16)
        return {};
    Marker marker{id3NumberAt(content, zero + 1) / 1000.0, {}};
    content.remove_prefix(zero + 17);
    while (const auto frame = firstId3Frame(content, version))
    {
        if (frame->name == "TIT2" && frame->content)
            marker.name = id3TextOf(*frame->content);
        content.remove_prefix(frame->bytes);
    }
    return marker;
}
} // namespace

FoundMarkers id3Chapters(std::string_view tag)
{
    FoundMarkers found;
    if (tag.size() < id3HeaderBytes || !tag.starts_with("ID3"))
        return found;
    const auto version = id3ByteAt(tag, 3);
    const auto flags = id3ByteAt(tag, 5);
    if (version < 3 || version > 4) // 2.2 has no chapters
        return found;
    const auto size = id3NumberAt(tag, 6, 7);
    tag.remove_prefix(id3HeaderBytes);
    const bool isCut = size > tag.size();
    tag = tag.substr(0, size);
    const std::string whole = version == 3 && (flags & 0x80u) != 0 ? resynchronised(tag) : std::string(tag);
    std::string_view frames = whole;
    if ((flags & 0x40u) != 0 && frames.size() >= 4)
    {
        // What it says of itself counts its own size only in 2.4.
        const auto extra =
            version == 4 ? std::size_t(id3NumberAt(frames, 0, 7)) : std::size_t(id3NumberAt(frames, 0)) + 4;
        frames.remove_prefix(std::min(extra, frames.size()));
    }
    std::size_t broken = 0, chapters = 0;
    while (const auto frame = firstId3Frame(frames, version))
    {
        if (frame->name == "CHAP")
        {
            ++chapters;
            auto chapter = frame->content ? chapterOf(*frame->content, version) : std::nullopt;
            if (chapter && chapter->name.empty())
                chapter->name = std::to_string(chapters);
            if (chapter)
                found.markers.push_back(std::move(*chapter));
            broken += chapter ? 0u : 1u;
        }
        frames.remove_prefix(frame->bytes);
    }
    if (broken > 0)
        found.warnings.push_back(fmt::format(
            "has {} chapters in its ID3 tag that are compressed, encrypted or damaged and left out", broken));
    if (isCut || (!frames.empty() && frames.front() != '\0'))
        found.warnings.emplace_back("has a damaged ID3 tag; chapters behind the damage are left out");
    return found;
}

} // namespace pacini
