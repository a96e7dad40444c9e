#include "io/CueChunks.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

namespace pacini
{

namespace
{
void putCueNumber(std::string& bytes, std::uint64_t value)
{
    for (unsigned shift = 0; shift < 32; shift += 8)
        bytes += static_cast<char>(value >> shift & 0xFFu);
}

std::string cueChunkOf(std::string_view name, const std::string& content)
{
    std::string chunk(name);
    putCueNumber(chunk, content.size());
    return chunk + content + std::string(content.size() % 2, '\0');
}
} // namespace

std::string cueChunks(const std::vector<Marker>& markers, int sampleRate)
{
    if (markers.empty())
        return {};
    std::string cues, labels = "adtl";
    std::uint64_t count = 0;
    for (const Marker& marker : markers)
    {
        const double frame = std::round(marker.time * sampleRate);
        if (!(frame >= 0.0 && frame <= std::numeric_limits<std::uint32_t>::max()))
            continue;
        ++count;
        const auto place = static_cast<std::uint64_t>(frame);
        putCueNumber(cues, count);
        putCueNumber(cues, place);
        cues += "data";
        putCueNumber(cues, 0);
        putCueNumber(cues, 0);
        putCueNumber(cues, place);
        std::string label;
        putCueNumber(label, count);
        labels += cueChunkOf("labl", label + marker.name + '\0');
    }
    std::string number;
    putCueNumber(number, count);
    return cueChunkOf("cue ", number + cues) + cueChunkOf("LIST", labels);
}

} // namespace pacini
