#include "io/OggTimes.h"

#include "io/OggPages.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::size_t checksumPlace = 22;

/// A page of an Ogg file with all its bytes, at most 65307.
struct Page
{
    std::uint64_t offset = 0;
    std::string bytes;

    [[nodiscard]] unsigned byte(std::size_t place) const noexcept { return static_cast<unsigned char>(bytes[place]); }
    [[nodiscard]] std::uint64_t number(std::size_t place, std::size_t count) const noexcept
    {
        std::uint64_t value = 0;
        for (std::size_t i = count; i-- > 0;)
            value = value << 8u | byte(place + i);
        return value;
    }
    /// Replaces a number of the header.
    void set(std::size_t place, std::size_t count, std::uint64_t value)
    {
        for (std::size_t i = 0; i < count; ++i)
            bytes[place + i] = static_cast<char>((value >> (8 * i)) & 0xFFu);
    }
    [[nodiscard]] std::size_t laces() const noexcept { return byte(26); }
    [[nodiscard]] bool endsStream() const noexcept { return (byte(5) & 4u) != 0; }
    [[nodiscard]] std::uint64_t time() const noexcept { return number(6, 8); }

    /// The checksum of the page, in which its own place counts as zeros.
    [[nodiscard]] std::uint32_t checksum() const noexcept
    {
        constexpr auto table = []
        {
            std::array<std::uint32_t, 256> all{};
            for (std::uint32_t i = 0; i < all.size(); ++i)
            {
                std::uint32_t rest = i << 24u;
                for (int bit = 0; bit < 8; ++bit)
                    rest = (rest << 1u) ^ ((rest & 0x80000000u) != 0 ? 0x04C11DB7u : 0u);
                all[i] = rest;
            }
            return all;
        }();
        std::uint32_t sum = 0;
        for (std::size_t i = 0; i < bytes.size(); ++i)
        {
            const bool isOwn = i >= checksumPlace && i < checksumPlace + 4;
            sum = (sum << 8u) ^ table[(sum >> 24u) ^ (isOwn ? 0u : byte(i))];
        }
        return sum;
    }
    [[nodiscard]] bool isSound() const noexcept { return number(checksumPlace, 4) == checksum(); }
};

/// The page at `offset`, if one is there and whole.
std::optional<Page> pageAt(ByteWindow& file, std::uint64_t offset, std::uint64_t end)
{
    const auto size = oggPageBytes(file, offset);
    const auto bytes = file.at(offset, static_cast<std::size_t>(size));
    if (size == 0 || bytes.size() < size || offset + size > end)
        return {};
    return Page{offset, {bytes.begin(), bytes.end()}};
}

/// Calls `take` with each page of the stream, until it returns false.
template <typename Take>
void forEachPage(ByteWindow& file, std::uint64_t begin, std::uint64_t end, std::uint64_t serial, Take take)
{
    for (auto offset = begin; offset < end;)
    {
        const auto page = pageAt(file, offset, end);
        if (page && page->number(14, 4) == serial && !take(*page))
            return;
        offset = page ? offset + page->bytes.size() : file.find("OggS", offset + 1, end);
    }
}

/// Bits of a packet, the lowest of each byte first.
std::uint64_t bitsOf(const std::string& packet, std::size_t place, std::size_t count)
{
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count && place + i < 8 * packet.size(); ++i)
        value |= ((static_cast<unsigned char>(packet[(place + i) / 8]) >> ((place + i) % 8)) & std::uint64_t{1}) << i;
    return value;
}

/// Counts the frames of a stream of Vorbis by its packets, the first three of which are headers.
class VorbisPackets
{
public:
    /// Takes the next packet; false where it is none of Vorbis.
    bool take(const std::string& packet)
    {
        const auto number = taken++;
        if (number == 0)
            return readSizes(packet);
        if (number == 2)
            return readModes(packet);
        if (number < 3)
            return true;
        const auto mode = bitsOf(packet, 1, modeBits);
        if (packet.empty() || bitsOf(packet, 0, 1) != 0 || mode >= isLong.size())
            return false;
        const auto size = sizes[isLong[static_cast<std::size_t>(mode)] ? 1 : 0];
        newest = number > 3 ? (previous + size) / 4 : 0;
        frames += newest;
        if (number <= 4)
            overlap = frames;
        previous = size;
        return true;
    }

    [[nodiscard]] bool isBehindHeaders() const noexcept { return taken > 3; }

    std::uint64_t frames = 0;
    std::uint64_t newest = 0;  ///< of these, those of the last packet
    std::uint64_t overlap = 0; ///< frames of the first two packets together

private:
    bool readSizes(const std::string& packet)
    {
        constexpr std::size_t place = std::size_t{8} * 28;
        if (packet.size() < 30 || !packet.starts_with("\1vorbis"))
            return false;
        sizes = {std::uint64_t{1} << bitsOf(packet, place, 4), std::uint64_t{1} << bitsOf(packet, place + 4, 4)};
        return true;
    }

    /// Modes are the last in the header of set-up, behind all that has other lengths: from the bit that ends it on they
    /// are read backwards, as many as the number in front of them says.
    bool readModes(const std::string& packet)
    {
        constexpr std::size_t bits = 41, most = 64;
        auto end = 8 * packet.size();
        while (end > 0 && bitsOf(packet, end - 1, 1) == 0)
            --end;
        if (end == 0)
            return false;
        --end;
        std::size_t found = 0;
        for (std::size_t count = 1; count <= most && end >= bits * count + 6; ++count)
        {
            const auto mode = end - bits * count;
            if (bitsOf(packet, mode + 1, 32) != 0 || bitsOf(packet, mode + 33, 8) >= most)
                break;
            if (bitsOf(packet, mode - 6, 6) + 1 == count)
                found = count;
        }
        for (std::size_t i = 0; i < found; ++i)
            isLong.push_back(bitsOf(packet, end - bits * (found - i), 1) != 0);
        while ((std::size_t{1} << modeBits) < found)
            ++modeBits;
        return found > 0;
    }

    std::size_t taken = 0;
    std::array<std::uint64_t, 2> sizes{};
    std::uint64_t previous = 0; ///< size of the block before
    std::vector<bool> isLong;
    std::size_t modeBits = 0;
};

/// Counts the frames at 48 kHz of a stream of Opus by its packets, the first two of which are headers (RFC 6716, 3.1).
class OpusPackets
{
public:
    /// Takes the next packet; false where it is none of Opus.
    bool take(const std::string& packet)
    {
        const auto number = taken++;
        if (number == 0)
            return packet.starts_with("OpusHead");
        if (number < 2)
            return true;
        const auto first = bitsOf(packet, 0, 8);
        const auto count = (first & 3u) == 0 ? 1u : (first & 3u) < 3 ? 2u : bitsOf(packet, 8, 6);
        newest = packet.empty() ? 0 : count * framesOf(first >> 3u);
        frames += newest;
        return true;
    }

    [[nodiscard]] bool isBehindHeaders() const noexcept { return taken > 2; }

    std::uint64_t frames = 0;
    std::uint64_t newest = 0; ///< of these, those of the last packet

private:
    /// Of a frame by the five bits of its configuration.
    static std::uint64_t framesOf(std::uint64_t configuration)
    {
        constexpr std::array<std::uint64_t, 4> speech{480, 960, 1920, 2880}, music{120, 240, 480, 960};
        if (configuration < 12)
            return speech[configuration & 3u];
        return configuration < 16 ? speech[configuration & 1u] : music[configuration & 3u];
    }

    std::size_t taken = 0;
};

/// Gives the packets of a stream to `lengths` until it refuses one, and calls `take` behind each page with whether a
/// packet of audio ends on it, until it returns false.
template <typename Lengths, typename Take>
void countPackets(ByteWindow& file, std::uint64_t begin, std::uint64_t end, std::uint64_t serial, Lengths& lengths,
                  Take take)
{
    constexpr std::size_t largest = 1u << 22u;
    std::string packet;
    forEachPage(file, begin, end, serial,
                [&](const Page& page)
                {
                    bool ends = false;
                    auto place = oggHeaderBytes + page.laces();
                    for (std::size_t i = 0; i < page.laces(); ++i)
                    {
                        const auto lace = page.byte(oggHeaderBytes + i);
                        packet.append(page.bytes, place, lace);
                        place += lace;
                        if (packet.size() > largest)
                            return false;
                        if (lace == 255)
                            continue;
                        if (!lengths.take(packet))
                            return false;
                        ends = lengths.isBehindHeaders();
                        packet.clear();
                    }
                    return take(page, ends && page.time() != ~std::uint64_t{0});
                });
}

constexpr std::uint64_t mostFrames = std::uint64_t{1} << 40u; // times that are later wrap around

/// The shift by the time of the first page with audio, without patches.
VorbisShift shiftOfStart(ByteWindow& file, std::uint64_t begin, std::uint64_t end, std::uint64_t serial)
{
    VorbisPackets lengths;
    VorbisShift shift;
    countPackets(file, begin, end, serial, lengths,
                 [&](const Page& page, bool hasTime)
                 {
                     if (!page.isSound())
                         return false;
                     if (!hasTime)
                         return true;
                     // The last page of a stream leaves out frames at its end.
                     if (const auto before = lengths.frames - page.time(); before < mostFrames && !page.endsStream())
                         shift = {before, before <= lengths.overlap, {}};
                     return false;
                 });
    return shift;
}

/// Counts those of either; of other streams, 0.
class SoundPackets
{
public:
    bool take(const std::string& packet)
    {
        isVorbis = isVorbis && vorbis.take(packet);
        isOpus = isOpus && opus.take(packet);
        return true;
    }

    [[nodiscard]] bool isBehindHeaders() const noexcept
    {
        return (isVorbis && vorbis.isBehindHeaders()) || (isOpus && opus.isBehindHeaders());
    }
    [[nodiscard]] std::uint64_t frames() const noexcept { return isVorbis ? vorbis.frames : isOpus ? opus.frames : 0; }
    [[nodiscard]] std::uint64_t newest() const noexcept { return isVorbis ? vorbis.newest : isOpus ? opus.newest : 0; }

private:
    VorbisPackets vorbis;
    OpusPackets opus;
    bool isVorbis = true, isOpus = true;
};
} // namespace

VorbisShift vorbisShift(ByteWindow& file, std::uint64_t begin, std::uint64_t end, std::uint64_t serial)
{
    VorbisShift shift = shiftOfStart(file, begin, end, serial);
    if (shift.frames == 0)
        return shift;
    bool isBehindHeaders = false;
    std::size_t packets = 0;
    forEachPage(file, begin, end, serial,
                [&](Page page)
                {
                    const auto laces = page.bytes.begin() + oggHeaderBytes;
                    const auto ended = std::count_if(laces, laces + static_cast<std::ptrdiff_t>(page.laces()),
                                                     [](char lace) { return static_cast<unsigned char>(lace) < 255; });
                    packets += static_cast<std::size_t>(ended);
                    isBehindHeaders = packets > 3;
                    if (!isBehindHeaders || page.time() == ~std::uint64_t{0} || !page.isSound())
                        return true; // those that are damaged stay so
                    page.set(6, 8, page.time() + shift.frames);
                    page.set(checksumPlace, 4, page.checksum());
                    shift.patches.push_back({page.offset, page.bytes.substr(0, oggHeaderBytes)});
                    return true;
                });
    return shift;
}

OggContent oggContent(ByteWindow& file, std::uint64_t begin, std::uint64_t end, std::uint64_t serial)
{
    SoundPackets lengths;
    OggContent content;
    std::int64_t start = 0, leftOut = 0;
    bool isTimed = false;
    countPackets(file, begin, end, serial, lengths,
                 [&](const Page& page, bool hasTime)
                 {
                     const bool isSound = page.isSound();
                     content.damagedPages += isSound ? 0u : 1u;
                     if (!hasTime || !isSound || page.time() > mostFrames)
                         return true;
                     const auto time = static_cast<std::int64_t>(page.time());
                     content.lastTime = std::max(content.lastTime, static_cast<std::uint64_t>(page.time()));
                     const auto frames = static_cast<std::int64_t>(lengths.frames());
                     if (!isTimed && !page.endsStream())
                         start = time - frames; // of a stream that was cut at its beginning, or begins before it
                     isTimed = true;
                     leftOut = page.endsStream() ? start + frames - time : 0;
                     return true;
                 });
    content.frames = lengths.frames();
    if (leftOut > 0 && leftOut >= static_cast<std::int64_t>(lengths.newest()))
        content.leftOut = static_cast<std::uint64_t>(leftOut);
    return content;
}

} // namespace pacini
