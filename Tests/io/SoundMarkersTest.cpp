#include "io/AudioBytes.h"
#include "io/AudioReader.h"
#include "io/SoundEncoder.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
struct Cue
{
    std::uint32_t frame;
    std::string name; // empty: without a label
};

std::string chunk(const std::string& name, const std::string& content)
{
    return name + littleEndian(content.size(), 4) + content + std::string(content.size() % 2, '\0');
}

// A second of sound at 8 kHz, and cues behind it.
std::string withCues(const std::vector<Cue>& cues)
{
    std::string points = littleEndian(cues.size(), 4);
    std::string labels = "adtl";
    for (std::size_t i = 0; i < cues.size(); ++i)
    {
        const auto id = littleEndian(i + 1, 4);
        points += id + littleEndian(cues[i].frame, 4) + "data" + littleEndian(0, 8) + littleEndian(cues[i].frame, 4);
        if (!cues[i].name.empty())
            labels += chunk("labl", id + cues[i].name + '\0');
    }
    std::vector<int> samples(8000);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = i % 80 < 40 ? 8000 : -8000;
    std::string bytes = wavBytes({}, pcm16(samples)) + chunk("cue ", points) + chunk("LIST", labels);
    return bytes.replace(4, 4, littleEndian(bytes.size() - 8, 4));
}

std::vector<Marker> markersOf(const std::string& bytes)
{
    TempFolder folder;
    const auto reader = AudioReader::open(put(folder / "cues.wav", bytes));
    REQUIRE(reader);
    return reader->markers();
}
} // namespace

TEST_CASE("Cues of a WAV are its markers, by their labels and in order", "[io]")
{
    CHECK(markersOf(withCues({{4000, "ring"}, {2000, "hit"}})) == std::vector<Marker>{{0.25, "hit"}, {0.5, "ring"}});
    CHECK(markersOf(withCues({{0, ""}, {8000, "end\xFF"}})) ==
          std::vector<Marker>{{0.0, "1"}, {1.0, "end\xEF\xBF\xBD"}});
    CHECK(markersOf(withCues({})).empty());
    CHECK(markersOf(wavBytes({}, pcm16({1, 2, 3}))).empty());
    std::vector<Cue> many;
    for (std::uint32_t i = 0; i < 500; ++i)
        many.push_back({16 * i, "m" + std::to_string(i)});
    CHECK(markersOf(withCues(many)).size() == 500);
}

TEST_CASE("A clip has the markers of its sound that lie within it", "[io]")
{
    TempFolder folder;
    const auto path = put(folder / "cues.wav", withCues({{2000, "hit"}, {9000, "beyond"}}));
    auto reader = AudioReader::open(path);
    REQUIRE(reader);
    SoundEncoder encoder{SoundEncoderParams{}};
    Stopwatch work;
    const auto clip = encoder.clipOf(
        *reader, path, [](double) {}, work);
    REQUIRE(clip);
    REQUIRE(clip->markers.size() == 1);
    CHECK(clip->markers[0].time == Approx(0.25).margin(0.001));
    CHECK(clip->markers[0].name == "hit");
    CHECK(onGrids(*clip) == *clip);
}
