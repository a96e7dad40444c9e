#include "io/MatroskaParts.h"

#include "io/ByteWindow.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <span>

namespace pacini
{

namespace
{
constexpr std::uint64_t head = 0x1A45DFA3, segment = 0x18538067, cluster = 0x1F43B675;

/// Those of a segment: what to seek, information, tracks, cues, chapters, attachments, tags; padding, checksum.
constexpr std::uint64_t ofSegment[] = {cluster,    0x114D9B74, 0x1549A966, 0x1654AE6B, 0x1C53BB6B,
                                       0x1043A770, 0x1941A469, 0x1254C367, 0xEC,       0xBF};

/// Those of a cluster: time, silent tracks, place, size before, blocks and groups of them; padding, checksum.
constexpr std::uint64_t ofCluster[] = {0xE7, 0x5854, 0xA7, 0xAB, 0xA3, 0xA0, 0xAF, 0xEC, 0xBF};

bool isAmong(std::span<const std::uint64_t> ids, std::uint64_t id)
{
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

/// A part: its id, and where its content begins and ends.
struct Element
{
    std::uint64_t id = 0;
    std::uint64_t content = 0;
    std::optional<std::uint64_t> end; ///< nothing: left open
};

/// The part that begins there; nothing where none can.
std::optional<Element> elementAt(ByteWindow& file, std::uint64_t offset)
{
    const auto widthAt = [&](std::uint64_t place)
    {
        return static_cast<std::size_t>(std::countl_zero(static_cast<unsigned char>(file.number(place, 1, true)))) + 1;
    };
    const auto idBytes = widthAt(offset);
    if (idBytes > 4 || offset + idBytes >= file.size())
        return {};
    const auto place = offset + idBytes;
    const auto sizeBytes = widthAt(place);
    if (sizeBytes > 8 || place + sizeBytes > file.size())
        return {};
    const auto open = (std::uint64_t{1} << 7u * sizeBytes) - 1;
    const auto size = file.number(place, sizeBytes, true) & open;
    Element found{file.number(offset, idBytes, true), place + sizeBytes, {}};
    if (size != open)
        found.end = found.content + size;
    return found;
}
} // namespace

std::uint64_t unknownBytesOfMatroska(std::FILE* opened, std::uint64_t begin)
{
    constexpr int most = 1 << 20; // parts
    ByteWindow file(opened);
    std::uint64_t unknown = 0;
    bool isInCluster = false;
    std::uint64_t clusterEnd = 0; // where it is stated
    auto offset = begin;
    for (int part = 0; part < most; ++part)
    {
        if (offset >= file.size())
            return unknown;
        if (clusterEnd > 0 && offset >= clusterEnd)
            isInCluster = false;
        const auto found = elementAt(file, offset);
        if (!found)
            return unknown + file.size() - offset;
        const auto id = found->id;
        if (id == segment || id == cluster)
        {
            isInCluster = id == cluster;
            clusterEnd = isInCluster ? found->end.value_or(0) : 0;
            offset = found->content;
            continue;
        }
        const bool isOfSegment = id == head || isAmong(ofSegment, id);
        const bool isKnown = isOfSegment || (isInCluster && isAmong(ofCluster, id));
        if (isOfSegment && id > 0xFF)
            isInCluster = false;
        const auto next = found->end.value_or(file.size());
        if (!isKnown)
            unknown += std::min(next, file.size()) - offset;
        offset = next;
    }
    return 0;
}

} // namespace pacini
