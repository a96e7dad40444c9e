#include "io/SoundLengths.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <span>
#include <string>
#include <string_view>

namespace pacini
{

namespace
{
using namespace std::string_view_literals;

constexpr std::uint64_t mostChannels = 1024; // of any of these formats: more are no header
constexpr int mostPieces = 1000;             // chunks, blocks or matrices in front of a sound

/// Where the samples are, and how many bytes of them the header states.
struct Samples
{
    std::uint64_t start = 0;
    std::uint64_t bytes = 0;
};

/// A number in the header of NIST behind its name and type, as in "sample_count -i 288000".
std::optional<std::uint64_t> numberNamed(std::string_view header, std::string_view name)
{
    const std::string line = "\n" + std::string(name) + " -i ";
    const auto found = header.find(line);
    if (found == std::string_view::npos)
        return {};
    std::uint64_t number = 0;
    const auto* const first = header.data() + found + line.size();
    const auto read = std::from_chars(first, header.data() + header.size(), number);
    return read.ec == std::errc() ? std::optional(number) : std::nullopt;
}

/// NIST, "SPHERE" 2.7: a text of as many bytes as its second line states.
std::optional<Samples> samplesOfNist(ByteWindow& file, std::uint64_t begin)
{
    constexpr std::size_t most = 16384;
    const auto bytes = file.at(begin, most);
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto digits = all.find_first_not_of(' ', 8);
    std::uint64_t size = 0;
    if (digits == std::string_view::npos ||
        std::from_chars(all.data() + digits, all.data() + all.size(), size).ec != std::errc() || size > most)
        return {};
    const auto header = all.substr(0, static_cast<std::size_t>(size));
    const auto count = numberNamed(header, "sample_count"), width = numberNamed(header, "sample_n_bytes");
    const auto channels = numberNamed(header, "channel_count").value_or(1);
    if (!count || !width || *width == 0 || *width > 8 || channels > mostChannels || *count > ~std::uint32_t{0})
        return {};
    return Samples{begin + size, *count * *width * channels};
}

/// Creative, "Creative Voice file format", 1994: blocks of a type and a size of three bytes; the first that has sound.
std::optional<Samples> samplesOfVoc(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    auto block = begin + file.number(begin + 20, 2, false);
    for (int i = 0; i < mostPieces && block + 4 < end; ++i)
    {
        const auto type = file.number(block, 1, false), size = file.number(block + 1, 3, false);
        constexpr std::uint64_t sound = 1, newSound = 9;
        const std::uint64_t described = type == sound ? 2 : type == newSound ? 12 : 0;
        // libsndfile and others write 0 where the size did not fit.
        if (described > 0)
            return size > described ? std::optional(Samples{block + 4 + described, size - described}) : std::nullopt;
        if (type == 0)
            return {};
        block += 4 + size;
    }
    return {};
}

/// AVR of the Atari: 128 bytes, big-endian, with the number of frames.
std::optional<Samples> samplesOfAvr(ByteWindow& file, std::uint64_t begin)
{
    const std::uint64_t channels = file.number(begin + 12, 2, true) == 0 ? 1 : 2;
    const auto bits = file.number(begin + 14, 2, true);
    if (bits != 8 && bits != 16)
        return {};
    return Samples{begin + 128, file.number(begin + 26, 4, true) * channels * (bits / 8)};
}

/// Electronic Arts, "8SVX IFF 8-bit sampled voice", 1985.
std::optional<Samples> samplesOfIff(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    auto chunk = begin + 12;
    for (int i = 0; i < mostPieces && chunk + 8 <= end; ++i)
    {
        const auto size = file.number(chunk + 4, 4, true);
        if (file.has(chunk, "BODY"))
            return Samples{chunk + 8, size};
        chunk += 8 + size + size % 2;
    }
    return {};
}

/// MathWorks, "MAT-File Format", chapter 2: matrices, the second of which is the sound.
std::optional<Samples> samplesOfMat4(ByteWindow& file, std::uint64_t begin, bool bigEndian)
{
    constexpr std::uint64_t fixedBytes = 20;
    constexpr std::uint64_t widths[] = {8, 4, 4, 2, 2, 1}; // by the type
    Samples samples{begin, 0};
    for (int i = 0; i < 2; ++i)
    {
        const auto matrix = samples.start + samples.bytes;
        const auto number = [&](std::uint64_t place)
        {
            return file.number(matrix + place, 4, bigEndian);
        };
        const auto type = number(0) / 10 % 10, rows = number(4), columns = number(8), letters = number(16);
        if (type >= std::size(widths) || rows == 0 || rows > mostChannels || letters == 0 || letters > 64)
            return {};
        samples = {matrix + fixedBytes + letters, rows * columns * widths[type]};
    }
    return samples;
}

/// The same, chapter 1: elements of a type and a size, filled up to 8 bytes; flags, dimensions, name and numbers within
/// those of a matrix.
std::optional<Samples> samplesOfMat5(ByteWindow& file, std::uint64_t begin)
{
    const bool bigEndian = file.has(begin + 126, "MI");
    constexpr std::uint64_t headerBytes = 128, matrix = 14;
    const auto number = [&](std::uint64_t place)
    {
        return file.number(place, 4, bigEndian);
    };
    const auto first = begin + headerBytes;
    const auto second = first + 8 + number(first + 4);
    if (number(first) != matrix || number(second) != matrix)
        return {};
    auto element = second + 8;
    for (int i = 0; i < 3; ++i) // a short one has its type and size in one number
        element += number(element) >> 16u != 0 ? 8 : 8 + (number(element + 4) + 7) / 8 * 8;
    return number(element) >> 16u == 0 ? std::optional(Samples{element + 8, number(element + 4)}) : std::nullopt;
}

/// Akai, MPC 2000: 42 bytes, little-endian, with the number of frames of 16 bits.
std::optional<Samples> samplesOfMpc(ByteWindow& file, std::uint64_t begin)
{
    const auto isStereo = file.number(begin + 21, 1, false);
    if (isStereo > 1)
        return {};
    return Samples{begin + 42, file.number(begin + 30, 4, false) * 2 * (isStereo + 1)};
}

/// A number of 21 bits, 7 of each byte.
std::uint64_t sevenBits(ByteWindow& file, std::uint64_t place)
{
    return file.number(place, 1, false) | file.number(place + 1, 1, false) << 7u |
           file.number(place + 2, 1, false) << 14u;
}

/// MIDI Manufacturers Association, "Sample Dump Standard", 1986: packets of 127 bytes, 120 of which are of samples.
std::optional<StatedSound> soundOfSds(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    constexpr std::uint64_t headerBytes = 21, packetBytes = 127, usedBytes = 120;
    const auto bits = file.number(begin + 6, 1, false);
    if (bits < 8 || bits > 28)
        return {};
    const auto inPacket = usedBytes / ((bits + 6) / 7);
    const std::uint64_t width = bits <= 8 ? 1 : bits <= 16 ? 2 : bits <= 24 ? 3 : 4;
    const auto samples = sevenBits(file, begin + 10);
    const auto body = end - std::min(end, begin + headerBytes);
    const auto packets = (samples + inPacket - 1) / inPacket * packetBytes;
    return StatedSound{samples * width, std::min(samples, body / packetBytes * inPacket) * width,
                       body - std::min(body, packets)};
}
/// Shifts the bits of one byte into a checksum with the highest bit first.
template <unsigned bits>
unsigned checksum(unsigned sum, unsigned char byte, unsigned polynomial)
{
    sum ^= static_cast<unsigned>(byte) << (bits - 8u);
    for (int i = 0; i < 8; ++i)
        sum = (sum << 1u) ^ ((sum >> (bits - 1u) & 1u) != 0 ? polynomial : 0u);
    return sum & ((1u << bits) - 1u);
}

constexpr std::size_t flacHeadBytes = 16; // at most

/// The head of a block of FLAC (RFC 9639, 9.1).
struct FlacHead
{
    bool isNumbered = false; ///< by blocks; else by frames
    std::uint64_t number = 0;
    std::uint64_t frames = 0; ///< of the block
};

std::optional<FlacHead> flacHeadAt(std::span<const unsigned char> bytes)
{
    if (bytes.size() < flacHeadBytes || bytes[0] != 0xFF || (bytes[1] & 0xFEu) != 0xF8)
        return {};
    const unsigned size = bytes[2] >> 4u, rate = bytes[2] & 15u;
    if (size == 0 || rate == 15 || bytes[3] >> 4u > 10 || (bytes[3] & 1u) != 0)
        return {};
    FlacHead head;
    head.isNumbered = (bytes[1] & 1u) == 0;
    // A number as UTF-8 has it, of up to 36 bits.
    std::size_t place = 4;
    const unsigned first = bytes[place++];
    std::size_t more = 0;
    while (more < 7 && (first & (0x80u >> more)) != 0)
        ++more;
    if (more == 1 || more > 7)
        return {};
    head.number = more == 0 ? first : first & (0x7Fu >> more);
    for (std::size_t i = 1; i < more; ++i)
    {
        if ((bytes[place] & 0xC0u) != 0x80)
            return {};
        head.number = head.number << 6u | (bytes[place++] & 0x3Fu);
    }
    if (size == 1)
        head.frames = 192;
    else if (size < 6)
        head.frames = 576u << (size - 2u);
    else if (size < 8)
    {
        head.frames = bytes[place++];
        if (size == 7)
            head.frames = head.frames << 8u | bytes[place++];
        ++head.frames;
    }
    else
        head.frames = 256u << (size - 8u);
    place += rate == 12 ? 1 : rate > 12 ? 2 : 0;
    unsigned sum = 0;
    for (std::size_t i = 0; i < place; ++i)
        sum = checksum<8>(sum, bytes[i], 0x07);
    return sum == bytes[place] ? std::optional(head) : std::nullopt;
}

/// Whether the checksum at the end of a block is right.
bool isWholeFlacBlock(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    unsigned sum = 0;
    while (begin < end)
    {
        const auto piece = file.at(begin, static_cast<std::size_t>(std::min<std::uint64_t>(end - begin, 4096)));
        if (piece.empty())
            return false;
        for (const unsigned char byte : piece)
            sum = checksum<16>(sum, byte, 0x8005);
        begin += piece.size();
    }
    return sum == 0;
}
} // namespace

std::optional<std::uint64_t> numberedFlacFrames(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    constexpr std::uint64_t reach = 1u << 20u, fewest = 9; // bytes of a last block: of usual encoders, and of silence
    const auto blockFrames = file.number(begin + 10, 2, true); // by STREAMINFO, the most
    const auto least = std::max(begin + 42, end - std::min(end, reach));
    for (auto place = end - std::min(end, fewest); place >= least; --place)
    {
        if (!file.has(place, "\xFF\xF8"sv) && !file.has(place, "\xFF\xF9"sv))
            continue;
        std::array<unsigned char, flacHeadBytes> bytes{};
        const auto there = file.at(place, bytes.size());
        std::copy(there.begin(), there.end(), bytes.begin());
        const auto head = flacHeadAt(bytes);
        if (!head || !isWholeFlacBlock(file, place, end))
            continue;
        return head->number * (head->isNumbered ? blockFrames : 1) + head->frames;
    }
    return {};
}

std::optional<StatedSound> statedSound(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    std::optional<Samples> samples;
    if (file.has(begin, "NIST_1A\n"))
        samples = samplesOfNist(file, begin);
    else if (file.has(begin, "Creative Voice File\x1A"))
        samples = samplesOfVoc(file, begin, end);
    else if (file.has(begin, "2BIT"))
        samples = samplesOfAvr(file, begin);
    else if (file.has(begin, "FORM") && (file.has(begin + 8, "8SVX") || file.has(begin + 8, "16SV")))
        samples = samplesOfIff(file, begin, end);
    else if (file.has(begin, "MATLAB 5.0 MAT-file"))
        samples = samplesOfMat5(file, begin);
    else if (file.has(begin, "\0\0\0\0\1\0\0\0\1\0\0\0\0\0\0\0"sv))
        samples = samplesOfMat4(file, begin, false);
    else if (file.has(begin, "\0\0\x03\xe8\0\0\0\1\0\0\0\1\0\0\0\0"sv))
        samples = samplesOfMat4(file, begin, true);
    else if (file.has(begin, "\1\4"))
        samples = samplesOfMpc(file, begin);
    else if (file.has(begin, "ALawSoundFile**\0"sv))
        samples = Samples{begin + 32, file.number(begin + 18, 4, true)};
    else if (file.has(begin, "\xF0\x7E") && file.has(begin + 3, "\1"))
        return soundOfSds(file, begin, end);
    if (!samples || samples->bytes == 0)
        return {};
    const auto there = end - std::min(end, samples->start);
    const auto present = std::min(there, samples->bytes);
    // Blocks of VOC that go on, and chunks of IFF, belong to the sound.
    const auto behind = samples->start + present;
    const bool goesOn = file.has(begin, "Creative") ? file.number(behind, 1, false) != 0
                                                    : file.has(begin, "FORM") && !file.has(behind, "FORM");
    return StatedSound{samples->bytes, present, goesOn ? 0 : there - present};
}

} // namespace pacini
