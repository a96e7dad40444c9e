#include "io/formats/ClipFormat.h"
#include "support/Catch.h"
#include "support/RandomClip.h"
#include "support/Skip.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
// Not without libzip.
bool hasPulsar()
{
    const bool has = clipFormatNamed("pulsar") != nullptr;
    if (!has)
        skip("bundles of Pulsar are not read here");
    return has;
}

std::string zipNumber(std::uint64_t value, int count)
{
    std::string bytes;
    for (int i = 0; i < count; ++i)
        bytes += static_cast<char>(value >> (8 * i) & 0xFFu);
    return bytes;
}

std::uint32_t zipCrc(std::string_view bytes)
{
    std::uint32_t crc = 0xFFFFFFFFu;
    for (const char c : bytes)
    {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1u ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

// An archive of stored files, by its specification (PKWARE, APPNOTE.TXT 6.3).
std::string zipOfFiles(const std::vector<std::pair<std::string, std::string>>& files)
{
    std::string bytes, directory;
    for (const auto& [name, content] : files)
    {
        const auto head = zipNumber(20, 2) + zipNumber(0, 8) + zipNumber(zipCrc(content), 4) +
                          zipNumber(content.size(), 4) + zipNumber(content.size(), 4) + zipNumber(name.size(), 2) +
                          zipNumber(0, 2);
        directory += "PK\1\2" + zipNumber(20, 2) + head + zipNumber(0, 10) + zipNumber(bytes.size(), 4) + name;
        bytes += "PK\3\4" + head + name + content;
    }
    return bytes + directory + "PK\5\6" + zipNumber(0, 4) + zipNumber(files.size(), 2) + zipNumber(files.size(), 2) +
           zipNumber(directory.size(), 4) + zipNumber(bytes.size(), 4) + zipNumber(0, 2);
}

const std::string pulsarPreset = R"({"id": "tap", "name": "Tap", "haptics": "haptics/tap.json"})";

std::string pulsarManifest(const std::string& presets, const std::string& schema = "pulsar.bundle/1")
{
    return R"({"schema": ")" + schema + R"(", "id": "a.b", "name": "x", "extra": 1, "presets": [)" + presets + "]}";
}

const std::string pulsarPattern =
    R"({"continuousPattern": {"amplitude": [{"time": 0, "value": 0.5}, {"time": 250.5, "value": 1}],
    "frequency": [{"time": 0, "value": 0}, {"time": 250, "value": 1}]},
    "discretePattern": [{"time": 100, "amplitude": 0.75, "frequency": 0.25}]})";

std::string pulsarBundle(const std::string& content = pulsarPattern,
                         const std::string& manifest = pulsarManifest(pulsarPreset))
{
    return zipOfFiles({{"haptics/tap.json", content}, {"manifest.json", manifest}});
}

Result<ImportedClip> readPulsarBundle(const std::string& bytes)
{
    return clipFormatNamed("pulsar")->read(bytes);
}

std::string pulsarErrorOf(const std::string& bytes)
{
    const auto imported = readPulsarBundle(bytes);
    return imported.ok() ? "" : imported.error().text();
}
} // namespace

TEST_CASE("A bundle of Pulsar is a clip of one voice and events", "[io][formats]")
{
    if (!hasPulsar())
        return;
    const auto read = readPulsarBundle(pulsarBundle());
    REQUIRE((read.ok() ? "" : read.error().text()) == "");
    CHECK(read->warnings.empty());
    CHECK(read->clip.name == "Tap");
    CHECK(read->clip.duration == Approx(0.2505));
    REQUIRE(read->clip.bands.size() == 1);
    CHECK(read->clip.bands[0].amplitude == Curve{{0.0, 0.5}, {0.2505, 1.0}});
    CHECK(read->clip.bands[0].pitch == Curve{{0.0, 65.0}, {0.25, 300.0}});
    CHECK(read->clip.transients == std::vector<Transient>{{0.1, 0.75, 0.25}});
    CHECK(clipFormatOf("", pulsarBundle()) == clipFormatNamed("pulsar"));
}

TEST_CASE("A bundle of Pulsar that is written is read again, and is the same each time", "[io][formats]")
{
    if (!hasPulsar())
        return;
    const ClipFormat& format = *clipFormatNamed("pulsar");
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u})
    {
        CAPTURE(seed);
        const Clip clip = randomFullClip(seed);
        const auto written = format.write(clip, {});
        REQUIRE(written);
        CHECK(format.write(clip, {})->files.front().bytes == written->files.front().bytes);
        const auto back = format.read(written->files.front().bytes);
        REQUIRE((back.ok() ? "" : back.error().text()) == "");
        CHECK(back->warnings.empty());
        const auto again = format.write(back->clip, {});
        REQUIRE(again);
        const auto twice = format.read(again->files.front().bytes);
        REQUIRE(twice);
        CHECK(twice->clip.transients.size() == back->clip.transients.size());
        CHECK(twice->clip.duration == Approx(back->clip.duration).margin(0.001));
    }
    CHECK(format.read(format.write(Clip{}, {})->files.front().bytes).ok());
}

TEST_CASE("What a bundle of Pulsar holds besides is named, and what is wrong refused with its place", "[io][formats]")
{
    if (!hasPulsar())
        return;
    const auto loud = readPulsarBundle(pulsarBundle(
        R"({"continuousPattern": {"amplitude": [{"time": 5, "value": 2}], "frequency": []}, "discretePattern": []})",
        pulsarManifest(R"({"id": "a", "haptics": "haptics/tap.json", "audio": {"src": "a.wav"}, "animation": {}})")));
    REQUIRE(loud);
    CHECK(loud->warnings.size() == 4);
    CHECK(loud->clip.name == "a");
    CHECK(pulsarErrorOf(pulsarBundle(pulsarPattern, pulsarManifest(pulsarPreset + "," + pulsarPreset))) ==
          "manifest.json: presets: has 2 presets ('Tap', 'Tap'), but a clip is one; unpack the bundle and put each in "
          "one of its own");
    CHECK(pulsarErrorOf(pulsarBundle(pulsarPattern, pulsarManifest(""))) == "manifest.json: presets: has no preset");
    CHECK(pulsarErrorOf(pulsarBundle(pulsarPattern, pulsarManifest(pulsarPreset, "pulsar.bundle/2"))) ==
          "manifest.json: schema: is \"pulsar.bundle/2\", but only pulsar.bundle/1 is read");
    CHECK(pulsarErrorOf(pulsarBundle(pulsarPattern, "{}")) == "manifest.json: schema: is missing");
    CHECK(pulsarErrorOf(pulsarBundle(pulsarPattern, "[")).starts_with("manifest.json: "));
    CHECK(pulsarErrorOf(zipOfFiles({{"manifest.json", pulsarManifest(pulsarPreset)}})) ==
          "haptics/tap.json: is missing in the archive");
    CHECK(pulsarErrorOf(zipOfFiles({{"a", "manifest.json"}})) == "manifest.json: is missing in the archive");
    CHECK(pulsarErrorOf(pulsarBundle("{}")) == "haptics/tap.json: continuousPattern: is missing");
    CHECK(pulsarErrorOf(pulsarBundle(R"({"continuousPattern": {}, "discretePattern": []})"))
              .starts_with("haptics/tap.json: "));
    for (const char* event : {R"({"time": -1, "amplitude": 1, "frequency": 1})", R"({"time": 1e300, "amplitude": 1,
        "frequency": 1})",
                              R"({"amplitude": 1, "frequency": 1})", "3", R"({"time": 1, "frequency": 1})"})
        CHECK(
            pulsarErrorOf(pulsarBundle(R"({"continuousPattern": {}, "discretePattern": [)" + std::string(event) + "]}"))
                .starts_with("haptics/tap.json: discretePattern[0]"));
    CHECK(pulsarErrorOf(
              pulsarBundle(R"({"continuousPattern": {"amplitude": [{"time": 5, "value": 1}, {"time": 4, "value": 1}]},
        "discretePattern": []})")) ==
          "haptics/tap.json: continuousPattern.amplitude[1]: is earlier than the point before it");
    const auto misspelt = readPulsarBundle(pulsarBundle(R"({"continuousPattern": {"amplitud": [], "frequenzy": []},
        "discretePattern": [{"time": 100, "amplitude": 0.75, "frequency": 0.25}], "audio": 1, "$schema": 2})"));
    REQUIRE(misspelt);
    CHECK(misspelt->warnings.size() == 3);
    CHECK(misspelt->warnings.back() == "continuousPattern.frequenzy: is unknown and left out");
    const auto whole = pulsarBundle();
    for (std::size_t length = 0; length < whole.size(); ++length)
        CHECK_FALSE(readPulsarBundle(whole.substr(0, length)));
    for (std::size_t at = 0; at < whole.size(); ++at)
    {
        auto broken = whole;
        broken[at] = static_cast<char>(broken[at] ^ 0x55);
        const auto read = readPulsarBundle(broken);
        CHECK((read.ok() || !read.error().message.empty()));
    }
}
