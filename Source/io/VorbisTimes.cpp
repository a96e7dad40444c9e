#include "io/VorbisTimes.h"

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

/// Counts the frames of a stream by its packets, the first three of which are headers.
class PacketLengths
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
        if (number > 3)
            frames += (last + size) / 4;
        if (number <= 4)
            overlap = frames;
        last = size;
        return true;
    }

    [[nodiscard]] bool isBehindHeaders() const noexcept { return taken > 3; }

    std::uint64_t frames = 0;
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
    std::uint64_t last = 0;
    std::vector<bool> isLong;
    std::size_t modeBits = 0;
};

/// The shift by the time of the first page with audio, without patches.
VorbisShift shiftOfStart(ByteWindow& file, std::uint64_t begin, std::uint64_t end, std::uint64_t serial)
{
    constexpr std::size_t largestHeader = 1u << 22u;
    constexpr std::uint64_t most = std::uint64_t{1} << 40u; // frames; times that are later wrap around
    PacketLengths lengths;
    std::string packet;
    VorbisShift shift;
    forEachPage(file, begin, end, serial,
                [&](const Page& page)
                {
                    if (!page.isSound())
                        return false;
                    bool ends = false; // a packet of audio, on this page
                    auto place = oggHeaderBytes + page.laces();
                    for (std::size_t i = 0; i < page.laces(); ++i)
                    {
                        const auto lace = page.byte(oggHeaderBytes + i);
                        packet.append(page.bytes, place, lace);
                        place += lace;
                        if (packet.size() > largestHeader)
                            return false;
                        if (lace == 255)
                            continue;
                        if (!lengths.take(packet))
                            return false;
                        ends = lengths.isBehindHeaders();
                        packet.clear();
                    }
                    const auto time = page.time();
                    if (!ends || time == ~std::uint64_t{0})
                        return true;
                    // The last page of a stream leaves out frames at its end.
                    if (const auto before = lengths.frames - time; before < most && !page.endsStream())
                        shift = {before, before <= lengths.overlap, {}};
                    return false;
                });
    return shift;
}
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

} // namespace pacini
