#include "io/SoundMarkers.h"

#include "io/SoundHandle.h"
#include "io/Utf8.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::uint32_t mostMarkers = 10000;
} // namespace

std::vector<Marker> soundMarkers(SNDFILE* file, int sampleRate)
{
    const SoundLibraryCall inside;
    std::uint32_t count = 0;
    if (sf_command(file, SFC_GET_CUE_COUNT, &count, sizeof count) != SF_TRUE || count == 0)
        return {};
    // libsndfile writes a count and, right behind it, as many cues as fit.
    constexpr std::size_t start = offsetof(SF_CUES, cue_points);
    count = std::min(count, mostMarkers);
    std::vector<std::byte> bytes(start + count * sizeof(SF_CUE_POINT));
    if (sf_command(file, SFC_GET_CUE, bytes.data(), static_cast<int>(bytes.size())) != SF_TRUE)
        return {};
    std::uint32_t stored = 0;
    std::memcpy(&stored, bytes.data(), sizeof stored);
    std::vector<Marker> markers;
    for (std::size_t i = 0; i < std::min(count, stored); ++i)
    {
        SF_CUE_POINT cue;
        std::memcpy(&cue, bytes.data() + start + i * sizeof cue, sizeof cue);
        std::string name(std::begin(cue.name), std::find(std::begin(cue.name), std::end(cue.name), '\0'));
        if (name.empty())
            name = std::to_string(i + 1);
        markers.push_back({static_cast<double>(cue.sample_offset) / sampleRate, wellFormedUtf8(name)});
    }
    std::stable_sort(markers.begin(), markers.end(), [](const Marker& a, const Marker& b) { return a.time < b.time; });
    return markers;
}

} // namespace pacini
