#include "io/SoundMarkers.h"

#include "io/AudioHeader.h"
#include "io/ByteWindow.h"
#include "io/CommentChapters.h"
#include "io/Id3Chapters.h"
#include "io/OggPages.h"
#include "io/SoundCues.h"
#include "io/SoundTags.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace pacini
{

namespace
{
using namespace std::string_view_literals;

/// `count` bytes from `offset` on, as far as they are there and no tag is longer.
std::string bytesOf(ByteWindow& file, std::uint64_t offset, std::uint64_t count)
{
    std::string bytes;
    count = std::min<std::uint64_t>(count, limits::tagBytes);
    while (bytes.size() < count)
    {
        const auto piece = file.at(offset + bytes.size(),
                                   static_cast<std::size_t>(std::min<std::uint64_t>(count - bytes.size(), file.most)));
        if (piece.empty())
            break;
        bytes.append(reinterpret_cast<const char*>(piece.data()), piece.size());
    }
    return bytes;
}

/// The chapters of all ID3 tags between `offset` and `end`.
void addTags(FoundMarkers& all, ByteWindow& file, std::uint64_t offset, std::uint64_t end)
{
    while (offset < end)
    {
        const auto bytes = tagBytesAt(file, offset);
        if (bytes == 0)
            return;
        if (file.has(offset, "ID3"))
            appendFound(all, id3Chapters(bytesOf(file, offset, std::min(bytes, end - offset))));
        offset += bytes;
    }
}

/// The list of comments of a FLAC stream, whose blocks of metadata begin at `offset`.
std::string flacComments(ByteWindow& file, std::uint64_t offset, std::uint64_t end)
{
    constexpr unsigned comments = 4, last = 0x80;
    while (offset + 4 <= end)
    {
        const auto type = file.number(offset, 1, true);
        const auto bytes = file.number(offset + 1, 3, true);
        if ((type & ~std::uint64_t(last)) == comments)
            return bytesOf(file, offset + 4, std::min(bytes, end - offset - 4));
        if ((type & last) != 0)
            break;
        offset += 4 + bytes;
    }
    return {};
}

/// The tracks of the cue sheet of a FLAC stream, whose blocks of metadata begin at `offset`. Behind 395 bytes and their
/// number come tracks of 36 bytes, the last of them the end, and behind each its indices of 12 (RFC 9639, 8.7).
FoundMarkers flacTracks(ByteWindow& file, std::uint64_t offset, std::uint64_t end, int sampleRate)
{
    constexpr unsigned sheet = 5, last = 0x80;
    constexpr std::uint64_t trackBytes = 36, indexBytes = 12;
    FoundMarkers found;
    for (; sampleRate > 0 && offset + 4 <= end;)
    {
        const auto type = file.number(offset, 1, true);
        const auto next = offset + 4 + file.number(offset + 1, 3, true);
        auto track = offset + 4 + 395;
        const auto count = file.number(track++, 1, true);
        for (std::uint64_t i = 0; (type & ~std::uint64_t(last)) == sheet && i + 1 < count; ++i)
        {
            if (track + trackBytes > std::min(next, end))
            {
                found.warnings.push_back(
                    fmt::format("has a cue sheet of {} tracks, of which {} can be read", count - 1, i));
                break;
            }
            const auto start = file.number(track, 8, true), number = file.number(track + 8, 1, true);
            const auto indices = file.number(track + 35, 1, true);
            track += trackBytes;
            std::uint64_t first = 0; // of index 1
            for (std::uint64_t index = 0; index < indices; ++index, track += indexBytes)
                if (file.number(track + 8, 1, true) == 1)
                    first = file.number(track, 8, true);
            found.markers.push_back({static_cast<double>(start + first) / sampleRate, std::to_string(number)});
        }
        if ((type & last) != 0)
            break;
        offset = next;
    }
    return found;
}

/// The second packet of the first stream of an Ogg file, which holds its comments (RFC 3533).
std::string oggComments(ByteWindow& file, std::uint64_t offset, std::uint64_t end)
{
    const auto serial = file.number(offset + 14, 4, false);
    std::string packet;
    int packets = 0; // that have ended
    while (offset + oggHeaderBytes <= end && file.has(offset, "OggS") && packet.size() < limits::tagBytes)
    {
        const auto laced =
            file.at(offset + oggHeaderBytes, static_cast<std::size_t>(file.number(offset + 26, 1, true)));
        const std::string lengths(laced.begin(), laced.end());
        const bool isOurs = file.number(offset + 14, 4, false) == serial;
        offset += oggHeaderBytes + lengths.size();
        for (const char length : lengths)
        {
            const auto bytes = static_cast<unsigned char>(length);
            if (isOurs && packets == 1)
                packet += bytesOf(file, offset, bytes);
            offset += bytes;
            packets += isOurs && bytes < 255 ? 1 : 0;
            if (packets == 2)
                return packet;
        }
    }
    return packet;
}

/// The comments behind what a codec writes before them.
std::string_view withoutCodecName(std::string_view packet)
{
    for (const auto name : {"\3vorbis"sv, "OpusTags"sv, "\x81theora"sv})
        if (packet.starts_with(name))
            return packet.substr(name.size());
    // FLAC in Ogg has its block of metadata there.
    return !packet.empty() && (packet.front() & 0x7F) == 4 ? packet.substr(std::min<std::size_t>(packet.size(), 4))
                                                           : std::string_view();
}

/// The loops of a WAV: 36 bytes, of which the 28th begins their number, then 24 bytes each, with first and last frame
/// at the 8th and 12th (Microsoft and IBM, "Multimedia Data Standards Update", 1994).
void addLoops(FoundMarkers& all, ByteWindow& file, const FileChunk& chunk, bool bigEndian, int sampleRate)
{
    constexpr std::uint64_t headerBytes = 36, loopBytes = 24;
    if (chunk.bytes < headerBytes || sampleRate <= 0)
        return;
    const auto stated = file.number(chunk.content + 28, 4, bigEndian);
    const auto there = std::min<std::uint64_t>({stated, (chunk.bytes - headerBytes) / loopBytes, limits::soundMarkers});
    std::uint64_t broken = stated - there;
    for (std::uint64_t i = 0; i < there; ++i)
    {
        const auto loop = chunk.content + headerBytes + i * loopBytes;
        const auto first = file.number(loop + 8, 4, bigEndian), last = file.number(loop + 12, 4, bigEndian);
        if (last < first)
        {
            ++broken;
            continue;
        }
        const auto name = i == 0 ? std::string("loop") : fmt::format("loop {}", i + 1);
        const double rate = sampleRate;
        all.markers.push_back({static_cast<double>(first) / rate, name + " start"});
        all.markers.push_back({static_cast<double>(last + 1) / rate, name + " end"});
    }
    if (broken > 0)
        all.warnings.push_back(fmt::format("has {} loops that are damaged and left out", broken));
}
} // namespace

FoundMarkers soundMarkers(std::FILE* opened, const SoundPart& part, std::uint64_t from, std::uint64_t until,
                          int sampleRate)
{
    ByteWindow file(opened);
    FoundMarkers tags;
    addTags(tags, file, from, part.begin);
    FoundMarkers behind;
    if (until == file.size())
        addTags(behind, file, part.end, until);
    if (file.has(part.begin, "fLaC"))
    {
        if (const std::string comments = flacComments(file, part.begin + 4, part.end); !comments.empty())
            appendFound(tags, commentChapters(comments));
        FoundMarkers tracks = flacTracks(file, part.begin + 4, part.end, sampleRate);
        if (tags.markers.empty()) // which have names
            appendFound(tags, std::move(tracks));
        else
            tags.warnings.insert(tags.warnings.end(), tracks.warnings.begin(), tracks.warnings.end());
    }
    if (file.has(part.begin, "OggS"))
    {
        const std::string packet = oggComments(file, part.begin, part.end);
        if (const auto comments = withoutCodecName(packet); !comments.empty())
            appendFound(tags, commentChapters(comments));
    }
    const auto begin = part.outerBegin.value_or(part.begin);
    const auto audio = findAudioChunk(file, begin, until);
    const auto audioBytes = part.presentBytes > 0 ? part.presentBytes : audio ? audio->promise.value_or(0) : 0;
    const auto audioEnd = audio && audioBytes > 0 ? audio->start + audioBytes : 0;
    const auto chunks = chunksOf(file, begin, until, audioEnd);
    for (const FileChunk& chunk : chunks)
    {
        if (file.has(chunk.offset, "id3 ") || file.has(chunk.offset, "ID3 "))
            appendFound(tags, id3Chapters(bytesOf(file, chunk.content, chunk.bytes)));
        else if (file.has(chunk.offset, "smpl"))
            addLoops(tags, file, chunk, file.has(begin, "RIFX"), sampleRate);
    }
    FoundMarkers found = cuesOf(file, begin, chunks, sampleRate);
    addMarkers(found, std::move(tags), 0.0);
    addMarkers(found, std::move(behind), 0.0);
    return found;
}

} // namespace pacini
