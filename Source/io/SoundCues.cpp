#include "io/SoundCues.h"

#include "io/TextMark.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace pacini
{

namespace
{
constexpr std::uint64_t cueBytes = 24; // id, place in the order of play, chunk, two places in that, frame

/// Cues and what is said of them.
struct CueList
{
    struct Cue
    {
        std::uint64_t id = 0;
        std::uint64_t played = 0; ///< frame, by the order of play
        std::uint64_t frame = 0;
    };
    std::vector<Cue> cues;
    std::map<std::uint64_t, std::string> names; ///< by id
    std::uint64_t stated = 0;
    std::uint64_t regions = 0;
    std::uint64_t unread = 0;                   ///< regions of which nothing is read
    std::uint64_t uncounted = 0;                ///< cues beyond the number that is stated
    std::map<std::uint64_t, std::string> notes; ///< by id, for cues without a label
};

std::string cueTextAt(ByteWindow& file, std::uint64_t offset, std::uint64_t bytes)
{
    const auto found = file.at(offset, static_cast<std::size_t>(std::min<std::uint64_t>(bytes, file.most)));
    const std::string_view text(reinterpret_cast<const char*>(found.data()), found.size());
    return utf8OfEither(text.substr(0, text.find('\0')));
}

void readCues(CueList& list, ByteWindow& file, const FileChunk& chunk, bool bigEndian)
{
    if (chunk.bytes < 4)
        return;
    const auto stated = file.number(chunk.content, 4, bigEndian), there = (chunk.bytes - 4) / cueBytes;
    list.stated += std::max(stated, there);
    list.uncounted += there > stated ? there - stated : 0;
    for (std::uint64_t i = 0; i < there; ++i)
    {
        const auto cue = chunk.content + 4 + i * cueBytes;
        list.cues.push_back(
            {file.number(cue, 4, bigEndian), file.number(cue + 4, 4, bigEndian), file.number(cue + 20, 4, bigEndian)});
    }
}

/// The labels of a list "adtl", and how many regions it has.
void readLabels(CueList& list, ByteWindow& file, const FileChunk& chunk, bool bigEndian)
{
    if (!file.has(chunk.content, "adtl"))
        return;
    const auto end = chunk.content + chunk.bytes;
    for (auto offset = chunk.content + 4; offset + 12 <= end;)
    {
        const auto bytes = std::min(file.number(offset + 4, 4, bigEndian), end - offset - 8);
        const auto id = file.number(offset + 8, 4, bigEndian);
        constexpr std::uint64_t fixedBytes = 20; // of "ltxt", before its text
        if (file.has(offset, "labl") && bytes > 4)
            list.names[id] = cueTextAt(file, offset + 12, bytes - 4);
        else if (file.has(offset, "note") && bytes > 4)
            list.notes[id] = cueTextAt(file, offset + 12, bytes - 4);
        else if (file.has(offset, "ltxt") && bytes >= 8)
        {
            list.regions += file.number(offset + 12, 4, bigEndian) > 0 ? 1u : 0u;
            if (bytes > fixedBytes)
                list.notes.try_emplace(id, cueTextAt(file, offset + 8 + fixedBytes, bytes - fixedBytes));
        }
        offset += 8 + bytes;
        // Some writers leave out the byte of padding.
        const auto isText = [&](std::uint64_t place)
        {
            return file.has(place, "labl") || file.has(place, "note") || file.has(place, "ltxt");
        };
        if (bytes % 2 != 0 && (isText(offset + 1) || !isText(offset)))
            ++offset;
    }
}

/// The markers of an AIFF: an id, a frame, and a name behind its length.
void readMarkers(CueList& list, ByteWindow& file, const FileChunk& chunk)
{
    constexpr std::uint64_t fixedBytes = 7;
    if (chunk.bytes < 2)
        return;
    const auto end = chunk.content + chunk.bytes;
    const auto stated = file.number(chunk.content, 2, true);
    list.stated += stated;
    auto offset = chunk.content + 2;
    for (std::uint64_t i = 0; i < stated && offset + fixedBytes <= end; ++i)
    {
        const auto frame = file.number(offset + 2, 4, true);
        const auto length = file.number(offset + 6, 1, true);
        list.names[list.cues.size()] =
            cueTextAt(file, offset + fixedBytes, std::min(length, end - offset - fixedBytes));
        list.cues.push_back({list.cues.size(), frame, frame});
        offset += fixedBytes + length + (length + 1) % 2;
    }
}

/// The markers of a CAF: a type, a frame in 64 bits of a float, an id, a time of SMPTE and a channel.
void readCafMarkers(CueList& list, ByteWindow& file, const FileChunk& chunk)
{
    constexpr std::uint64_t headerBytes = 8, markerBytes = 28;
    if (chunk.bytes < headerBytes)
        return;
    const auto stated = file.number(chunk.content + 4, 4, true);
    list.stated += stated;
    for (std::uint64_t i = 0; i < std::min(stated, (chunk.bytes - headerBytes) / markerBytes); ++i)
    {
        const auto marker = chunk.content + headerBytes + i * markerBytes;
        const auto frame = std::bit_cast<double>(file.number(marker + 4, 8, true));
        constexpr double largest = 1e15;
        if (!(frame >= 0.0 && frame < largest))
            continue; // which counts as one that cannot be read
        const auto whole = static_cast<std::uint64_t>(std::llround(frame));
        list.cues.push_back({file.number(marker + 12, 4, true), whole, whole});
    }
}

/// The texts of a CAF: their number, an id and a place of each, and the texts.
void readCafNames(CueList& list, ByteWindow& file, const FileChunk& chunk)
{
    constexpr std::uint64_t headerBytes = 4, entryBytes = 12;
    if (chunk.bytes < headerBytes)
        return;
    const auto stated = file.number(chunk.content, 4, true);
    const auto texts = chunk.content + headerBytes + stated * entryBytes;
    const auto end = chunk.content + chunk.bytes;
    for (std::uint64_t i = 0; i < std::min(stated, (chunk.bytes - headerBytes) / entryBytes); ++i)
    {
        const auto entry = chunk.content + headerBytes + i * entryBytes;
        const auto place = file.number(entry + 4, 8, true);
        if (texts < end && place < end - texts)
            list.names[file.number(entry, 4, true)] = cueTextAt(file, texts + place, end - texts - place);
    }
}
} // namespace

FoundMarkers cuesOf(ByteWindow& file, std::uint64_t begin, const std::vector<FileChunk>& chunks, int sampleRate)
{
    const bool bigEndian = file.has(begin, "RIFX");
    const bool isAiff = file.has(begin, "FORM"), isCaf = file.has(begin, "caff");
    CueList list;
    for (const FileChunk& chunk : chunks)
    {
        if (isCaf && file.has(chunk.offset, "mark"))
            readCafMarkers(list, file, chunk);
        else if (isCaf && file.has(chunk.offset, "strg"))
            readCafNames(list, file, chunk);
        else if (isCaf && file.has(chunk.offset, "regn") && chunk.bytes >= 8)
            list.unread += file.number(chunk.content + 4, 4, true);
        else if (!isAiff && file.has(chunk.offset, "cue "))
            readCues(list, file, chunk, bigEndian);
        else if (!isAiff && file.has(chunk.offset, "LIST"))
            readLabels(list, file, chunk, bigEndian);
        else if (isAiff && file.has(chunk.offset, "MARK"))
            readMarkers(list, file, chunk);
    }
    FoundMarkers found;
    // Some programs count the frames only in the order of play.
    const bool byPlay = std::all_of(list.cues.begin(), list.cues.end(), [](const auto& cue) { return cue.frame == 0; });
    for (const auto& cue : list.cues)
    {
        std::string name;
        for (const auto* texts : {&list.names, &list.notes})
            if (const auto text = texts->find(cue.id); name.empty() && text != texts->end())
                name = text->second;
        found.markers.push_back({static_cast<double>(byPlay ? cue.played : cue.frame) / sampleRate,
                                 name.empty() ? std::to_string(found.markers.size() + 1) : name});
    }
    if (list.cues.size() < list.stated)
        found.warnings.push_back(
            fmt::format("states {} markers, of which {} can be read", list.stated, list.cues.size()));
    if (list.uncounted > 0)
        found.warnings.push_back(fmt::format("states {} markers, but has {}, which are all read",
                                             list.stated - list.uncounted, list.stated));
    if (list.unread > 0)
        found.warnings.push_back(fmt::format("has {} regions, which are left out", list.unread));
    if (list.regions > 0)
        found.warnings.push_back(
            fmt::format("has {} regions, whose starts are read as markers, but not how long they last", list.regions));
    return found;
}

} // namespace pacini
