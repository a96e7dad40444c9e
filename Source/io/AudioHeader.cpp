#include "io/AudioHeader.h"

#include "io/FileHandle.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string_view>

namespace pacini
{

namespace
{
using Bytes = std::array<unsigned char, 48>;

std::uint64_t number(std::span<const unsigned char> bytes, bool bigEndian)
{
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
        value = (value << 8) | bytes[bigEndian ? i : bytes.size() - 1 - i];
    return value;
}

bool startsWith(std::span<const unsigned char> bytes, std::string_view text)
{
    return std::equal(text.begin(), text.end(), bytes.begin(),
                      [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

/// How a chunked format lays its chunks out: an id, then a size, then the content.
struct ChunkLayout
{
    std::string_view fileId;    ///< first four bytes of the file
    std::string_view dataId;    ///< first four bytes of the audio chunk's id
    std::uint64_t firstChunk;   ///< offset in bytes
    std::size_t idBytes;        ///< length of an id
    std::size_t sizeBytes;      ///< length of a size
    bool bigEndian;             ///< byte order of sizes
    bool sizeCountsHeader;      ///< a chunk's size includes its id and size
    std::uint64_t alignment;    ///< chunks start at multiples of it
    std::uint64_t headerOfData; ///< bytes of the audio chunk before the first sample
};

// Sources: Microsoft and IBM, "Multimedia Programming Interface and Data Specifications 1.0", 1991 (RIFF);
// EBU Tech 3306, 2009 (RF64); Apple, "Audio Interchange File Format 1.3", 1989, and "Apple Core Audio Format
// Specification 1.0", 2006; Sony Pictures, "Wave64 file format", 2003.
constexpr ChunkLayout layouts[] = {
    {"RIFF", "data", 12, 4, 4, false, false, 2, 0}, {"RIFX", "data", 12, 4, 4, true, false, 2, 0},
    {"RF64", "data", 12, 4, 4, false, false, 2, 0}, {"FORM", "SSND", 12, 4, 4, true, false, 2, 8},
    {"caff", "data", 8, 4, 8, true, false, 1, 4},   {"riff", "data", 40, 16, 8, false, true, 8, 0},
};

/// Sizes that writers leave behind when they cannot seek back: all ones, and what SoX writes.
bool isLeftOpen(std::uint64_t size, const ChunkLayout& layout)
{
    if (layout.sizeBytes == 8)
        return size == std::numeric_limits<std::uint64_t>::max();
    return size == 0xFFFFFFFFu || size == 0x7FFFFFFFu || size == 0x7FFFF000u;
}

AudioDataSize sizes(std::uint64_t promised, std::uint64_t start, std::uint64_t fileBytes)
{
    return AudioDataSize{promised, std::min(promised, fileBytes - std::min(start, fileBytes))};
}

std::optional<AudioDataSize> walk(std::FILE* file, const ChunkLayout& layout, std::uint64_t fileBytes)
{
    constexpr int maxChunks = 10000;
    const auto headerBytes = layout.idBytes + layout.sizeBytes;
    std::optional<std::uint64_t> longSize;
    auto offset = layout.firstChunk;
    for (int chunk = 0; chunk < maxChunks && offset + headerBytes <= fileBytes; ++chunk)
    {
        Bytes bytes{};
        if (!seekStream(file, static_cast<std::int64_t>(offset), SEEK_SET))
            return {};
        const auto got = std::fread(bytes.data(), 1, headerBytes + 16, file);
        const auto id = std::span(bytes).first(layout.idBytes);
        auto size = number(std::span(bytes).subspan(layout.idBytes, layout.sizeBytes), layout.bigEndian);
        const auto content = offset + headerBytes;
        // RF64 keeps the 64-bit sizes of file and data in a chunk of their own.
        if (layout.fileId == "RF64" && startsWith(id, "ds64") && got >= headerBytes + 16)
            longSize = number(std::span(bytes).subspan(headerBytes + 8, 8), false);
        if (startsWith(id, layout.dataId))
        {
            if (size == 0xFFFFFFFFu && longSize)
                size = *longSize;
            else if (isLeftOpen(size, layout))
                return {};
            const auto extra = layout.headerOfData + (layout.sizeCountsHeader ? headerBytes : 0);
            return sizes(size - std::min(size, extra), content + layout.headerOfData, fileBytes);
        }
        if (size > fileBytes)
            return {};
        const auto whole = layout.sizeCountsHeader ? std::max<std::uint64_t>(size, headerBytes) : size + headerBytes;
        offset = (offset + whole + layout.alignment - 1) / layout.alignment * layout.alignment;
    }
    return {};
}
} // namespace

std::optional<AudioDataSize> audioDataSize(std::FILE* file)
{
    if (!seekStream(file, 0, SEEK_END))
        return {};
    const auto end = tellStream(file);
    if (end < 0 || !seekStream(file, 0, SEEK_SET))
        return {};
    const auto fileBytes = static_cast<std::uint64_t>(end);
    Bytes start{};
    if (std::fread(start.data(), 1, 16, file) < 12)
        return {};
    for (const ChunkLayout& layout : layouts)
        if (startsWith(start, layout.fileId))
            return walk(file, layout, fileBytes);
    // AU: the size of the header, then the size of the audio, big-endian (Sun, "audio.h").
    if (startsWith(start, ".snd"))
    {
        const auto promised = number(std::span(start).subspan(8, 4), true);
        if (promised != 0xFFFFFFFFu)
            return sizes(promised, number(std::span(start).subspan(4, 4), true), fileBytes);
    }
    return {};
}

bool hasMp3FrameCount(std::FILE* file)
{
    std::array<unsigned char, 64> bytes{};
    if (!seekStream(file, 0, SEEK_SET) || std::fread(bytes.data(), 1, 10, file) != 10)
        return false;
    std::int64_t offset = 0;
    // ID3v2 in front: its size has 7 bits per byte (M. Nilsson, "ID3 tag version 2.4.0", 2000).
    if (startsWith(bytes, "ID3"))
        offset = 10 + ((bytes[6] & 0x7F) << 21 | (bytes[7] & 0x7F) << 14 | (bytes[8] & 0x7F) << 7 | (bytes[9] & 0x7F));
    if (!seekStream(file, offset, SEEK_SET))
        return false;
    const auto got = std::fread(bytes.data(), 1, bytes.size(), file);
    // Behind the 4 bytes of the frame's header and at most 32 bytes of side information.
    for (std::size_t i = 4; i + 8 <= got; ++i)
        for (std::string_view id : {"Xing", "Info"})
            if (startsWith(std::span(bytes).subspan(i), id))
                return (bytes[i + 7] & 1u) != 0;
    return false;
}

} // namespace pacini
