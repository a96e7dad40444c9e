#include "io/AudioHeader.h"

#include "io/SoundTags.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace pacini
{

namespace
{
// Sources: Microsoft and IBM, "Multimedia Programming Interface and Data Specifications 1.0", 1991 (RIFF);
// EBU Tech 3306, 2009 (RF64); ITU-R BS.2088-1, 2019 (BW64); Apple, "Audio Interchange File Format 1.3", 1989, and
// "Apple Core Audio Format Specification 1.0", 2006; Sony Pictures, "Wave64 file format", 2003.
constexpr ChunkLayout layouts[] = {
    {"RIFF", "data", 12, 4, 4, false, false, 2, 0}, {"RIFX", "data", 12, 4, 4, true, false, 2, 0},
    {"RF64", "data", 12, 4, 4, false, false, 2, 0}, {"BW64", "data", 12, 4, 4, false, false, 2, 0},
    {"FORM", "SSND", 12, 4, 4, true, false, 2, 8},  {"caff", "data", 8, 4, 8, true, false, 1, 4},
    {"riff", "data", 40, 16, 8, false, true, 8, 0},
};

constexpr int maxChunks = 10000;

/// Sizes that writers leave behind when they cannot seek back: all ones or the largest of a signed number, less some
/// header or rounded to frames and blocks; and numbers that are round in either system.
bool isLeftOpen(std::uint64_t size, std::size_t sizeBytes)
{
    if (sizeBytes == 8)
        return size >= std::uint64_t{1} << 62u;
    constexpr std::uint64_t rounding = 65536;
    constexpr std::uint64_t half = 0x80000000u;
    return (size <= half && size >= half - rounding) || size >= 2 * half - rounding ||
           (size >= 1'000'000'000 && size % 100'000'000 == 0);
}

/// What the 64-bit sizes of RF64 hold when nobody wrote them.
bool isLeftOpen64(std::uint64_t size)
{
    return isLeftOpen(size, 8) || (size <= std::numeric_limits<std::uint32_t>::max() && isLeftOpen(size, 4));
}

/// Whether `offset` has the start of a chunk: an id of letters, digits and marks.
bool hasId(ByteWindow& file, const ChunkLayout& layout, std::uint64_t offset)
{
    const auto id = file.at(offset, 4);
    return id.size() == 4 && file.at(offset, layout.idBytes).size() == layout.idBytes && id[0] != ' ' &&
           std::all_of(id.begin(), id.end(), [](unsigned char c) { return c >= 0x20 && c < 0x7F; });
}

std::uint64_t aligned(const ChunkLayout& layout, std::uint64_t offset, std::uint64_t begin)
{
    return begin + (offset - begin + layout.alignment - 1) / layout.alignment * layout.alignment;
}

/// Where the chunk after that at `offset` is; nothing if that does not fit before `end`.
std::optional<std::uint64_t> nextChunk(ByteWindow& file, const ChunkLayout& layout, std::uint64_t offset,
                                       std::uint64_t end)
{
    const auto headerBytes = layout.idBytes + layout.sizeBytes;
    if (end < headerBytes || offset > end - headerBytes)
        return {};
    const auto size = file.number(offset + layout.idBytes, layout.sizeBytes, layout.bigEndian);
    if (size > end)
        return {};
    const auto whole = layout.sizeCountsHeader ? std::max<std::uint64_t>(size, headerBytes) : size + headerBytes;
    return offset + whole;
}

/// Where the first chunk of a list of waves is, if one begins at `offset`: audio and silence one behind the other.
std::optional<std::uint64_t> insideWaves(ByteWindow& file, const ChunkLayout& layout, std::uint64_t offset)
{
    const bool isList = layout.isWave() && file.has(offset, "LIST") && file.has(offset + 8, "wavl");
    return isList ? std::optional(offset + 12) : std::nullopt;
}

/// The frames of silence that the chunk at `offset` states, 0 for other chunks.
std::uint64_t silenceAt(ByteWindow& file, const ChunkLayout& layout, std::uint64_t offset)
{
    return layout.isWave() && file.has(offset, "slnt") ? file.number(offset + 8, 4, layout.bigEndian) : 0;
}

/// Where the chunk begins that follows one whose content ends at `next`: chunks of odd length may lack the byte of
/// padding behind them.
std::uint64_t behindPadding(ByteWindow& file, const ChunkLayout& layout, std::uint64_t next, std::uint64_t begin)
{
    const auto padded = aligned(layout, next, begin);
    return padded == next || hasId(file, layout, padded) || !hasId(file, layout, next) ? padded : next;
}

/// The bytes of audio of the frames that an AIFF states in its COMM; nothing for packed codecs.
std::optional<std::uint64_t> statedByAiff(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    for (const FileChunk& chunk : chunksOf(file, begin, end, 0))
    {
        if (!file.has(chunk.offset, "COMM") || chunk.bytes < 18)
            continue;
        const auto channels = file.number(chunk.content, 2, true);
        const auto bits = bitsOfAifcCodec(file, chunk).value_or(file.number(chunk.content + 6, 2, true));
        const auto codec = chunk.content + 18;
        const bool isPacked =
            chunk.bytes >= 22 && (file.has(codec, "ima4") || file.has(codec, "GSM ") || file.has(codec, "agsm") ||
                                  file.has(codec, "DWVW") || file.has(codec, ".mp") || file.has(codec, "MAC"));
        if (isPacked)
            return {};
        return file.number(chunk.content + 2, 4, true) * channels * ((bits + 7) / 8);
    }
    return {};
}

/// An AIFF may place its first frame some bytes behind the start of the audio, for blocks of a disc. Writers that leave
/// the number to chance are told by the frames that the file states.
bool isTrueOffset(ByteWindow& file, std::uint64_t begin, std::uint64_t end, const AudioChunk& chunk,
                  std::uint64_t offset)
{
    constexpr std::uint64_t usual = 4096, largest = 65536; // sizes of blocks
    const auto there = std::min(chunk.promise.value_or(~std::uint64_t{0}), chunk.present(end));
    if (offset > there)
        return false;
    if (const auto stated = statedByAiff(file, begin, chunk.sizeField); stated && *stated > 0)
    {
        if (there >= *stated && there - *stated >= offset)
            return true;
        if (there >= *stated)
            return false;
        return offset <= usual;
    }
    return offset <= largest;
}

/// The audio chunk whose id is at `offset`, of the file that begins at `begin`. `longSize` is that of a ds64.
AudioChunk audioChunkAt(ByteWindow& file, const ChunkLayout& layout, std::uint64_t begin, std::uint64_t offset,
                        std::uint64_t end, std::optional<std::uint64_t> longSize)
{
    const auto headerBytes = layout.idBytes + layout.sizeBytes;
    AudioChunk found;
    found.layout = &layout;
    found.bigEndian = layout.bigEndian;
    found.sizeField = offset + layout.idBytes;
    found.start = offset + headerBytes + layout.headerOfData;
    found.sizeExtra = layout.headerOfData + (layout.sizeCountsHeader ? headerBytes : 0);
    const auto size = file.number(found.sizeField, layout.sizeBytes, layout.bigEndian);
    if (size == 0xFFFFFFFFu && longSize)
    {
        if (!isLeftOpen64(*longSize))
            found.promise = *longSize;
    }
    else if (!isLeftOpen(size, layout.sizeBytes))
        found.promise = size - std::min(size, found.sizeExtra);
    if (layout.fileId != "FORM")
        return found;
    const auto field = offset + headerBytes;
    const auto skipped = file.number(field, 4, true);
    if (skipped == 0)
        return found;
    if (found.promise == 0u ? skipped > 4096 : !isTrueOffset(file, begin, end, found, skipped))
    {
        found.wrongOffset = field;
        return found;
    }
    found.start += skipped;
    found.sizeExtra += skipped;
    if (found.promise)
        found.promise = *found.promise - std::min(*found.promise, skipped);
    return found;
}

std::optional<AudioChunk> walk(ByteWindow& file, const ChunkLayout& layout, std::uint64_t begin, std::uint64_t end)
{
    const auto headerBytes = layout.idBytes + layout.sizeBytes;
    std::optional<std::uint64_t> longSize;
    bool isUnpadded = false;
    int formats = 0; // libsndfile gives up at a second one
    bool isInWaves = false;
    std::uint64_t silence = 0;
    auto offset = begin + layout.firstChunk;
    for (int chunk = 0; chunk < maxChunks && offset + headerBytes <= end; ++chunk)
    {
        // RF64 keeps the 64-bit sizes of file and data in a chunk of their own.
        if ((layout.fileId == "RF64" || layout.fileId == "BW64") && file.has(offset, "ds64") &&
            offset + headerBytes + 16 <= end)
            longSize = file.number(offset + headerBytes + 8, 8, false);
        if (file.has(offset, layout.dataId))
        {
            auto found = audioChunkAt(file, layout, begin, offset, end, longSize);
            // An empty one, and the audio in another behind it: what a recorder began, and what it wrote at last.
            if (found.promise == 0u)
                if (auto later = nextAudioChunk(file, layout, begin, found.start, end); later && later->promise != 0u)
                    return later;
            found.isHidden = isUnpadded || isInWaves || (layout.isWave() && formats != 1);
            found.silence = silence;
            return found;
        }
        if (const auto inside = insideWaves(file, layout, offset))
        {
            isInWaves = true;
            offset = *inside;
            continue;
        }
        silence += silenceAt(file, layout, offset);
        formats += layout.isWave() && file.has(offset, "fmt ") ? 1 : 0;
        const auto next = nextChunk(file, layout, offset, end);
        if (!next)
            return {};
        offset = behindPadding(file, layout, *next, begin);
        isUnpadded = isUnpadded || offset != aligned(layout, *next, begin);
    }
    return {};
}

/// Where the sound of an AU begins whose offset leads into its annotation: behind the zero that ends the text. Nothing
/// where the offset may be true.
std::optional<std::uint64_t> behindAnnotation(ByteWindow& file, std::uint64_t begin, const AudioChunk& chunk,
                                              std::uint64_t end)
{
    constexpr std::uint64_t fixedBytes = 24, most = 65536, fewest = 16; // letters, which samples do not make by chance
    constexpr std::uint64_t muLaw = 1, eightBits = 2, aLaw = 27;        // whose samples may look like some
    const auto text = begin + fixedBytes;
    if (chunk.start < text || chunk.start - text > most)
        return {};
    auto letters = text;
    for (; letters < std::min(end, text + most); ++letters)
        if (const auto letter = file.number(letters, 1, true);
            (letter < 0x20 || letter > 0x7E) && letter != '\n' && letter != '\r' && letter != '\t')
            break;
    const auto codec = file.number(begin + 12, 4, chunk.bigEndian);
    const bool mayBeSound = chunk.start == text && (codec == muLaw || codec == eightBits || codec == aLaw);
    if (mayBeSound || letters < chunk.start + 4 || letters - text < fewest || letters >= end ||
        file.number(letters, 1, true) != 0)
        return {};
    const auto behind = letters + 1;
    // Zeros fill the text up, to what the size leaves or to a multiple of 8 bytes.
    const auto bySize = chunk.promise && *chunk.promise < end ? end - *chunk.promise : behind;
    if (bySize > behind && bySize - behind < fewest && areZeros(file, behind, bySize))
        return bySize;
    const auto filled = begin + (behind - begin + 7) / 8 * 8;
    return areZeros(file, behind, std::min(filled, end)) ? filled : behind;
}
} // namespace

std::optional<AudioChunk> findAudioChunk(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    if (file.at(begin, 16).size() < 12)
        return {};
    for (const ChunkLayout& layout : layouts)
        if (file.has(begin, layout.fileId))
            return walk(file, layout, begin, end);
    // AU: the size of the header, then the size of the audio, big-endian (Sun, "audio.h"); DEC wrote it the other way
    // round.
    const bool isSun = file.has(begin, ".snd");
    if (!isSun && !file.has(begin, "dns."))
        return {};
    AudioChunk found;
    found.bigEndian = isSun;
    found.sizeField = begin + 8;
    found.start = begin + file.number(begin + 4, 4, isSun);
    if (const auto size = file.number(found.sizeField, 4, isSun); !isLeftOpen(size, 4))
        found.promise = size;
    if (const auto behind = behindAnnotation(file, begin, found, end))
    {
        found.start = *behind;
        found.wrongOffset = begin + 4;
        found.rightOffset = *behind - begin;
    }
    return found;
}

std::optional<std::uint64_t> bitsOfAifcCodec(ByteWindow& file, const FileChunk& comm)
{
    constexpr std::uint64_t fixedBytes = 18; // before the codec
    if (comm.bytes < fixedBytes + 4)
        return {};
    for (const auto& [codec, bits] : {std::pair("in24", 24u), std::pair("in32", 32u), std::pair("fl32", 32u),
                                      std::pair("FL32", 32u), std::pair("fl64", 64u), std::pair("FL64", 64u)})
        if (file.has(comm.content + fixedBytes, codec))
            return bits;
    return {};
}

std::uint64_t frameBytesOf(ByteWindow& file, std::uint64_t begin, std::uint64_t end)
{
    if (file.has(begin, ".snd") || file.has(begin, "dns."))
    {
        const bool isSun = file.has(begin, ".snd");
        constexpr std::uint64_t widths[] = {0, 1, 1, 2, 3, 4, 4, 8};
        const auto codec = file.number(begin + 12, 4, isSun);
        return codec < std::size(widths) ? widths[codec] * file.number(begin + 20, 4, isSun) : 0;
    }
    for (const FileChunk& chunk : chunksOf(file, begin, end, 0))
    {
        if (file.has(chunk.offset, "fmt ") && chunk.bytes >= 16)
        {
            constexpr std::uint64_t pcm = 1, floats = 3, extensible = 0xFFFE;
            const bool isBig = file.has(begin, "RIFX");
            const auto codec = file.number(chunk.content, 2, isBig);
            return codec == pcm || codec == floats || codec == extensible ? file.number(chunk.content + 12, 2, isBig)
                                                                          : 0;
        }
        if (file.has(chunk.offset, "COMM") && chunk.bytes == 18) // without a codec
            return file.number(chunk.content, 2, true) * ((file.number(chunk.content + 6, 2, true) + 7) / 8);
        if (file.has(chunk.offset, "desc") && chunk.bytes >= 32 && file.has(chunk.content + 8, "lpcm"))
            return file.number(chunk.content + 16, 4, true);
    }
    return 0;
}

std::optional<AudioChunk> nextAudioChunk(ByteWindow& file, const ChunkLayout& layout, std::uint64_t begin,
                                         std::uint64_t offset, std::uint64_t end)
{
    std::uint64_t silence = 0;
    for (int chunk = 0; chunk < maxChunks && offset < end; ++chunk)
    {
        if (!hasId(file, layout, offset) || startsSound(file, offset))
            return {};
        if (const auto inside = insideWaves(file, layout, offset))
        {
            offset = *inside;
            continue;
        }
        silence += silenceAt(file, layout, offset);
        if (file.has(offset, layout.dataId))
        {
            auto found = audioChunkAt(file, layout, begin, offset, end, {});
            found.isHidden = true;
            found.silence = silence;
            return found.present(end) > 0 ? std::optional(found) : std::nullopt;
        }
        const auto next = nextChunk(file, layout, offset, end);
        if (!next)
            return {};
        offset = behindPadding(file, layout, *next, begin);
    }
    return {};
}

bool startsSound(ByteWindow& file, std::uint64_t offset)
{
    using namespace std::string_view_literals;
    for (const std::string_view id : {"RIFF", "RIFX", "RF64", "BW64"})
        if (file.has(offset, id))
            return file.has(offset + 8, "WAVE");
    if (file.has(offset, "FORM"))
        return file.has(offset + 8, "AIF");
    if (file.has(offset, "dns."))
        return file.number(offset + 4, 4, false) < 65536;
    for (const std::string_view id : {"caff\0\1"sv, "riff\x2e\x91\xcf\x11"sv, ".snd\0\0"sv, "fLaC\0\0\0"sv, "OggS\0"sv})
        if (file.has(offset, id))
            return true;
    return false;
}

bool areZeros(ByteWindow& file, std::uint64_t offset, std::uint64_t end)
{
    while (offset < end)
    {
        const auto piece = file.at(offset, static_cast<std::size_t>(std::min<std::uint64_t>(end - offset, 4096)));
        if (piece.empty() || std::any_of(piece.begin(), piece.end(), [](unsigned char c) { return c != 0; }))
            return false;
        offset += piece.size();
    }
    return true;
}

std::optional<std::uint64_t> endOfChunks(ByteWindow& file, const ChunkLayout& layout, std::uint64_t offset,
                                         std::uint64_t end, std::optional<std::uint64_t>* tag)
{
    for (int chunk = 0; chunk < maxChunks; ++chunk)
    {
        if (offset >= end)
            return end;
        if (startsSound(file, offset))
            return offset;
        if (chunk > 0 && areZeros(file, offset, end))
            return end;
        if (const auto bytes = file.has(offset, "ID3") ? tagBytesAt(file, offset) : 0;
            bytes > 0 && bytes <= end - offset && !hasId(file, layout, offset))
        {
            if (tag && !*tag)
                *tag = offset;
            offset += bytes;
            continue;
        }
        if (!hasId(file, layout, offset) || file.has(offset, layout.dataId))
            return {};
        const auto next = nextChunk(file, layout, offset, end);
        if (!next || *next > end)
            return {};
        const auto padded = aligned(layout, *next, 0);
        offset = padded >= end ? padded : behindPadding(file, layout, *next, 0);
    }
    return {};
}

std::vector<FileChunk> chunksOf(ByteWindow& file, std::uint64_t begin, std::uint64_t end, std::uint64_t audioEnd)
{
    const auto* const layout = std::find_if(std::begin(layouts), std::end(layouts),
                                            [&](const ChunkLayout& known) { return file.has(begin, known.fileId); });
    if (layout == std::end(layouts))
        return {};
    const auto headerBytes = layout->idBytes + layout->sizeBytes;
    std::vector<FileChunk> chunks;
    auto offset = begin + layout->firstChunk;
    while (offset < end && hasId(file, *layout, offset) && chunks.size() < maxChunks)
    {
        const bool isAudio = file.has(offset, layout->dataId) && audioEnd > offset;
        const auto next = isAudio ? audioEnd : nextChunk(file, *layout, offset, end).value_or(end);
        const auto content = std::min(end, offset + headerBytes);
        if (!isAudio)
            chunks.push_back({offset, content, std::min(next, end) - content});
        offset = behindPadding(file, *layout, next, begin);
    }
    return chunks;
}

std::uint64_t startOfLastChunks(ByteWindow& file, const ChunkLayout& layout, std::uint64_t from, std::uint64_t end)
{
    // The chunks that programs put behind the audio.
    constexpr std::string_view usual[] = {"LIST", "id3 ", "ID3 ", "bext", "cue ", "smpl", "fact", "PEAK",
                                          "iXML", "JUNK", "junk", "axml", "chna", "inst", "acid", "_PMX",
                                          "NAME", "AUTH", "ANNO", "MARK", "COMM", "INST", "info", "free"};
    constexpr std::uint64_t reach = 32768;
    auto first = end;
    const auto begin = std::max(from, end > reach ? end - reach : 0);
    for (const std::string_view id : usual)
        for (auto place = file.find(id, begin, end); place < end; place = file.find(id, place + 1, end))
            if (place < first && endOfChunks(file, layout, place, end) == end)
                first = place;
    return first;
}

} // namespace pacini
