#include "io/SoundCodec.h"

#include "io/AudioHeader.h"
#include "io/OggPages.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

namespace pacini
{

namespace
{
using namespace std::string_view_literals;

// Sources: IANA, "WAVE and AVI codec registries", RFC 2361, 1998; those of AudioHeader.cpp; RFC 3533 (Ogg).

SoundCodec codecOfWave(std::uint64_t tag)
{
    // PCM, ADPCM (Microsoft), float, A-law, mu-law, ADPCM (IMA), GSM 6.10, VBXADPCM, G.721.
    constexpr std::uint64_t plain[] = {0x0001, 0x0002, 0x0003, 0x0006, 0x0007, 0x0011, 0x0031, 0x0038, 0x0040};
    if (tag == 0x0050 || tag == 0x0055)
        return SoundCodec::mpeg;
    return std::find(std::begin(plain), std::end(plain), tag) != std::end(plain) ? SoundCodec::plain
                                                                                 : SoundCodec::foreign;
}

/// By the four characters that AIFF and CAF name a codec with.
SoundCodec codecOfName(ByteWindow& file, std::uint64_t place)
{
    for (const auto name : {".mp1"sv, ".mp2"sv, ".mp3"sv})
        if (file.has(place, name))
            return SoundCodec::mpeg;
    for (const auto name :
         {"NONE"sv, "twos"sv, "sowt"sv, "raw "sv, "in24"sv, "ni24"sv, "42ni"sv, "in32"sv, "ni32"sv, "23ni"sv, "fl32"sv,
          "FL32"sv, "fl64"sv, "FL64"sv, "alaw"sv, "ALAW"sv, "ulaw"sv, "ULAW"sv, "DWVW"sv, "GSM "sv, "agsm"sv, "lpcm"sv})
        if (file.has(place, name))
            return SoundCodec::plain;
    return SoundCodec::foreign;
}

/// Whether all streams of an Ogg file are ones that libsndfile decodes, by their first pages.
SoundCodec codecOfOgg(ByteWindow& file, std::uint64_t begin)
{
    constexpr std::uint64_t beginsStream = 2;
    for (int stream = 0; stream < 64; ++stream)
    {
        if (!file.has(begin, "OggS") || (file.number(begin + 5, 1, true) & beginsStream) == 0)
            break;
        const auto packet = begin + oggHeaderBytes + file.number(begin + 26, 1, true);
        if (!file.has(packet, "\1vorbis") && !file.has(packet, "OpusHead"))
            return SoundCodec::foreign;
        begin += oggPageBytes(file, begin);
    }
    return SoundCodec::plain;
}
} // namespace

SoundCodec soundCodecOf(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    if (file.has(begin, "OggS"))
        return codecOfOgg(file, begin);
    if (const bool isSun = file.has(begin, ".snd"); isSun || file.has(begin, "dns."))
    {
        const auto encoding = file.number(begin + 12, 4, isSun); // 23 to 26: G.721 and G.723, 24: G.722
        const bool isPlain = encoding <= 7 || encoding == 23 || encoding == 25 || encoding == 26 || encoding == 27;
        return isPlain ? SoundCodec::plain : SoundCodec::foreign;
    }
    const bool isCaf = file.has(begin, "caff"), isAiff = file.has(begin, "FORM");
    for (const FileChunk& chunk : chunksOf(file, begin, end, 0))
    {
        if (isCaf && file.has(chunk.offset, "desc") && chunk.bytes >= 12)
            return codecOfName(file, chunk.content + 8);
        if (isAiff && file.has(chunk.offset, "COMM"))
            return chunk.bytes >= 22 ? codecOfName(file, chunk.content + 18) : SoundCodec::plain;
        if (isCaf || isAiff || !file.has(chunk.offset, "fmt "))
            continue;
        const bool bigEndian = file.has(begin, "RIFX");
        const auto tag = file.number(chunk.content, 2, bigEndian);
        constexpr std::uint64_t extensible = 0xFFFE;
        return codecOfWave(tag == extensible && chunk.bytes >= 26 ? file.number(chunk.content + 24, 2, bigEndian)
                                                                  : tag);
    }
    return SoundCodec::plain;
}

bool isCutOgg(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    constexpr std::uint64_t beginsStream = 2, endsStream = 4;
    std::set<std::uint64_t> open; // streams by their numbers
    while (begin + oggHeaderBytes <= end && file.has(begin, "OggS"))
    {
        const auto flags = file.number(begin + 5, 1, true), serial = file.number(begin + 14, 4, false);
        if ((flags & beginsStream) != 0)
            open.insert(serial);
        if ((flags & endsStream) != 0)
            open.erase(serial);
        const auto bytes = oggPageBytes(file, begin);
        if (bytes == 0 || begin + bytes > end)
            return true;
        begin += bytes;
    }
    return !open.empty();
}

std::optional<std::string> opusGainWarning(int gain)
{
    // Programs that level loudness write up to some 30 dB.
    constexpr double most = 40.0;
    const double decibels = gain / 256.0;
    if (decibels > most)
        return fmt::format("has a header that makes it {:.0f} dB louder", decibels);
    if (decibels < -most)
        return fmt::format("has a header that makes it {:.0f} dB softer", -decibels);
    return {};
}

std::string primingWarning(int frames, int sampleRate)
{
    return fmt::format("does not tell how its encoder was primed, so its sound may come up to {:.0f} ms late",
                       1000.0 * frames / sampleRate);
}

} // namespace pacini
