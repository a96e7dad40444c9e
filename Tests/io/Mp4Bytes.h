#pragma once

// MP4 files box by box (ISO/IEC 14496-12).

#include "io/AudioBytes.h"

#include <cstdint>
#include <string>

namespace pacini::test
{

inline std::string mp4Box(const std::string& name, const std::string& content)
{
    return bigEndian(content.size() + 8, 4) + name + content;
}

/// A sound of `blocks` blocks of AAC of 1024 frames, `perChunk` in a chunk, of which the last counts `last` frames, in
/// a file whose header comes first; the blocks themselves are no sound.
inline std::string mp4Bytes(std::uint32_t blocks, std::uint32_t rate, std::uint32_t perChunk = 10,
                            std::uint32_t last = 1024)
{
    constexpr std::uint32_t blockBytes = 20, scale = 1000;
    const auto ticks = (blocks - 1) * 1024 + last;
    const auto duration = static_cast<std::uint32_t>(std::uint64_t{ticks} * scale / rate);
    const std::string plain(4, '\0');
    const std::string entry =
        mp4Box("mp4a", std::string(7, '\0') + '\1' + std::string(8, '\0') + bigEndian(1, 2) + bigEndian(16, 2) + plain +
                           bigEndian(rate, 2) + std::string(2, '\0') + mp4Box("esds", plain + std::string(20, '\3')));
    std::string sizes, chunks;
    for (std::uint32_t i = 0; i < blocks; ++i)
        sizes += bigEndian(blockBytes, 4);
    const auto chunkCount = blocks / perChunk;
    for (std::uint32_t i = 0; i < chunkCount; ++i)
        chunks += bigEndian(1000 + i * perChunk * blockBytes, 4);
    const std::string tables =
        mp4Box("stsd", plain + bigEndian(1, 4) + entry) +
        mp4Box("stts", plain + (last == 1024 ? bigEndian(1, 4) + bigEndian(blocks, 4) + bigEndian(1024, 4)
                                             : bigEndian(2, 4) + bigEndian(blocks - 1, 4) + bigEndian(1024, 4) +
                                                   bigEndian(1, 4) + bigEndian(last, 4))) +
        mp4Box("stsc", plain + bigEndian(1, 4) + bigEndian(1, 4) + bigEndian(perChunk, 4) + bigEndian(1, 4)) +
        mp4Box("stsz", plain + plain + bigEndian(blocks, 4) + sizes) +
        mp4Box("stco", plain + bigEndian(chunkCount, 4) + chunks);
    const std::string media = mp4Box("mdhd", plain + plain + plain + bigEndian(rate, 4) + bigEndian(ticks, 4) + plain) +
                              mp4Box("hdlr", plain + plain + "soun" + std::string(13, '\0')) +
                              mp4Box("minf", mp4Box("smhd", plain + plain) + mp4Box("stbl", tables));
    const std::string track = mp4Box("tkhd", std::string(84, '\0')) +
                              mp4Box("edts", mp4Box("elst", plain + bigEndian(1, 4) + bigEndian(duration, 4) + plain +
                                                                bigEndian(0x10000, 4))) +
                              mp4Box("mdia", media);
    const std::string movie =
        mp4Box("mvhd", plain + plain + plain + bigEndian(scale, 4) + bigEndian(duration, 4) + std::string(80, '\0')) +
        mp4Box("trak", track);
    return mp4Box("ftyp", "M4A " + plain) + mp4Box("moov", movie) +
           mp4Box("mdat", std::string(std::size_t{blocks} * blockBytes, 'x'));
}

/// The same sound in `fragments` of `perFragment` blocks, which are told of in front of each.
inline std::string fragmentedMp4Bytes(std::uint32_t fragments, std::uint32_t perFragment, std::uint32_t rate)
{
    constexpr std::uint32_t blockBytes = 20;
    const std::string plain(4, '\0');
    std::string whole = mp4Bytes(1, rate, 1);
    whole.resize(whole.find("mdat") - 4);
    // Its tables are empty; there are no edits, but the lengths of blocks where nothing else is stated.
    for (const std::string table : {"stts", "stsc", "stsz", "stco"})
    {
        const auto place = whole.find(table);
        const auto count = place + (table == "stsz" ? 12 : 8);
        whole.replace(count, 4, plain);
    }
    whole.replace(whole.find("edts"), 4, "free");
    const std::string more =
        mp4Box("mvex", mp4Box("trex", plain + plain + bigEndian(1, 4) + bigEndian(1024, 4) + plain + plain));
    const auto movie = whole.find("moov") - 4;
    whole.replace(movie, 4, bigEndian(whole.size() - movie + more.size(), 4));
    whole += more;
    std::string run = bigEndian(0x201, 4) + bigEndian(perFragment, 4) + plain;
    for (std::uint32_t i = 0; i < perFragment; ++i)
        run += bigEndian(blockBytes, 4);
    for (std::uint32_t i = 0; i < fragments; ++i)
        whole += mp4Box("moof", mp4Box("mfhd", plain + bigEndian(i + 1, 4)) +
                                    mp4Box("traf", mp4Box("tfhd", bigEndian(0x20000, 4) + plain) +
                                                       mp4Box("tfdt", plain + bigEndian(i * perFragment * 1024, 4)) +
                                                       mp4Box("trun", run))) +
                 mp4Box("mdat", std::string(std::size_t{perFragment} * blockBytes, 'x'));
    return whole;
}

} // namespace pacini::test
