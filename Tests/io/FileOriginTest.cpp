#include "io/FileOrigin.h"

#include "io/AudioFile.h"
#include "io/ClipSeal.h"
#include "io/Fingerprint.h"
#include "io/formats/json/ClipJson.h"
#include "support/Catch.h"
#include "support/RandomClip.h"
#include "support/TempFolder.h"

#include <pacini/clip/PackedClip.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace fs = std::filesystem;

namespace
{
AudioWriteParams made(const fs::path& input, const fs::path& output, SampleEncoding encoding)
{
    AudioWriteParams params;
    params.encoding = encoding;
    params.origin = originOf(input, output, std::string(16, '7'));
    return params;
}
} // namespace

TEST_CASE("A sound file says what it was made from, and whether it is still as it was made", "[io]")
{
    const TempFolder folder;
    const std::vector<float> samples(200000, 0.25f);
    for (const auto& [name, encoding] :
         {std::pair("a.wav", SampleEncoding::float32), std::pair("b.wav", SampleEncoding::pcm24),
          std::pair("c.flac", SampleEncoding::pcm16)})
    {
        CAPTURE(name);
        const fs::path path = folder / name;
        const auto params = made(folder / "door.json", path, encoding);
        REQUIRE(writeAudio(path, samples, params).ok());
        const auto found = readOrigin(path);
        REQUIRE(found.has_value());
        CHECK(*found == *params.origin);
        CHECK(found->input == "door.json");
        CHECK(isAsMade(path));
        CHECK(readAudio(path)->samples == samples);

        const std::string whole = bytesOf(path);
        for (const std::size_t at : {std::size_t{10}, whole.size() / 2, whole.size() - 1})
        {
            std::string other = whole;
            other[at] = static_cast<char>(other[at] ^ 1);
            put(path, other);
            CHECK_FALSE(isAsMade(path));
        }
        put(path, whole + "x");
        CHECK_FALSE(isAsMade(path));
        put(path, whole.substr(0, whole.size() - 1));
        CHECK_FALSE(isAsMade(path));
        put(path, whole);
        CHECK(isAsMade(path));
    }
}

TEST_CASE("A seal as version 0.1 wrote it is still a seal", "[io]")
{
    const TempFolder folder;
    for (const std::size_t more : {0u, 1u, 63u, 64u, 65536u, 200001u})
    {
        const FileOrigin origin{"door.json", std::string(16, '1'), std::string(16, '2')};
        std::string whole = originText(origin) + std::string(more, 'x');
        Fingerprint print;
        print.add(whole);
        whole.replace(whole.find("seal ") + 5, 16, print.text());
        put(folder / "old", whole);
        CHECK(isAsMade(folder / "old"));
        whole.back() = whole.back() == 'x' ? 'y' : '(';
        put(folder / "old", whole);
        CHECK_FALSE(isAsMade(folder / "old"));
    }
}

TEST_CASE("The fingerprint of large files changes with each bit, with the order and with the length", "[io]")
{
    Random random(42);
    std::vector<std::byte> bytes(300);
    for (auto& byte : bytes)
        byte = static_cast<std::byte>(random.next() & 0xFFu);
    const auto print = [](std::span<const std::byte> of)
    {
        StripedFingerprint fingerprint;
        fingerprint.add(of);
        return fingerprint.text();
    };
    std::set<std::string> prints{print(bytes)};
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit)
    {
        auto changed = bytes;
        changed[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
        prints.insert(print(changed));
    }
    CHECK(prints.size() == 8 * bytes.size() + 1);
    for (std::size_t length = 0; length < bytes.size(); ++length)
        prints.insert(print(std::span(bytes).first(length)));
    CHECK(prints.size() == 9 * bytes.size() + 1);
    auto swapped = bytes;
    std::swap_ranges(swapped.begin(), swapped.begin() + 64, swapped.begin() + 64);
    CHECK(prints.insert(print(swapped)).second);
    // In pieces it is the same, and so it is on every machine.
    StripedFingerprint pieces;
    pieces.add(std::span(bytes).first(128));
    pieces.add(std::span(bytes).subspan(128));
    CHECK(pieces.text() == print(bytes));
    CHECK(print({}) == "7784e14bff05a7cd");
    CHECK(print(std::vector<std::byte>(1000, std::byte{0x80})) == "1d8ec27ef35fb440");
}

TEST_CASE("A long sound in an RF64 carries its origin as well", "[io]")
{
    const TempFolder folder;
    auto params = made(folder / "door.json", folder / "a.wav", SampleEncoding::float32);
    params.expectedFrames = 2'000'000'000; // announced, so that the container is chosen for it
    REQUIRE(AudioWriter::create(folder / "a.wav", params)->finish().ok());
    CHECK(readOrigin(folder / "a.wav") == params.origin);
    CHECK(isAsMade(folder / "a.wav"));
}

TEST_CASE("What was not made by Pacini has no origin", "[io]")
{
    const TempFolder folder;
    REQUIRE(writeAudio(folder / "a.wav", std::vector<float>(100, 0.5f), {}).ok());
    put(folder / "text", "Made by Pacini from \"x\" (place 0123");
    put(folder / "long", "Made by Pacini from \"x\" (place 0123456789abcdeg, substance 0123456789abcdef, seal "
                         "0123456789abcdef)");
    for (const char* name : {"a.wav", "text", "long", "missing", "."})
    {
        CHECK_FALSE(readOrigin(folder / name).has_value());
        CHECK_FALSE(isAsMade(folder / name));
    }
}

TEST_CASE("The place of an input is told as seen from the output, so that a tree may move", "[io]")
{
    const TempFolder folder;
    const auto place = [&](const char* input, const char* output)
    {
        return originOf(folder / input, folder / output, {}).place;
    };
    CHECK(place("a/x.json", "a/x.wav") == place("b/x.json", "b/x.wav"));
    CHECK(place("a/x.json", "out/x.wav") != place("b/x.json", "out/x.wav"));
    CHECK(place("a/x.json", "a/x.wav") == place("a/../a/./x.json", "b/../a/x.wav"));
    CHECK(originOf("/a/h\xC3\xA4 \"ptik\n.json", "/a/x.wav", {}).input == "h__ _ptik_.json");
}

TEST_CASE("The seal of a clip holds in both its forms and breaks with any change", "[io]")
{
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
        Clip clip = test::randomFullClip(seed);
        clip = unpackClip(packClip(clip, packParamsFor(clip))).value();
        CHECK(sealOf(clip) == ClipSeal::missing);
        sealClip(clip);
        CHECK(sealOf(clip) == ClipSeal::whole);
        const Clip once = clip;
        sealClip(clip);
        CHECK(clip == once);
        CHECK(sealOf(readClipJson(writeClipJson(clip)).value()) == ClipSeal::whole);
        CHECK(sealOf(unpackClip(packClip(clip, packParamsFor(clip))).value()) == ClipSeal::whole);

        Clip changed = clip;
        changed.name += "x";
        CHECK(sealOf(changed) == ClipSeal::broken);
        changed = clip;
        changed.duration += 1e-6;
        CHECK(sealOf(changed) == ClipSeal::broken);
        changed = clip;
        changed.markers.push_back({0.0, "here"});
        CHECK(sealOf(changed) == ClipSeal::broken);
        changed = clip;
        changed.encoder.back().value = std::string("no number");
        CHECK(sealOf(changed) == ClipSeal::broken);
    }
}

TEST_CASE("Every number, text and parameter of a clip counts for its seal", "[io]")
{
    Clip clip;
    clip.duration = 2.0;
    clip.envelope = {{0.0, 0.5}};
    clip.centroid = {{0.0, 100.0}};
    clip.bands = {{50.0, 75.0, 100.0, 1, {{0.0, 0.25}}, {{0.0, 60.0}}}};
    clip.transients = {{0.5, 0.5, 0.5}};
    clip.noise = {{10.0, 20.0, {{0.0, 0.125}}}};
    clip.markers = {{1.0, "m"}};
    clip.encoder = {{"text", std::string("t")}, {"number", 1.0}, {"truth", false}};
    sealClip(clip);
    REQUIRE(sealOf(clip) == ClipSeal::whole);
    const auto breaks = [&](auto change)
    {
        Clip other = clip;
        change(other);
        return sealOf(other) == ClipSeal::broken;
    };
    CHECK(breaks([](Clip& c) { c.envelope[0].value = 0.25; }));
    CHECK(breaks([](Clip& c) { c.envelope[0].time = 0.25; }));
    CHECK(breaks([](Clip& c) { c.envelope.clear(); }));
    CHECK(breaks([](Clip& c) { c.centroid[0].value = 101.0; }));
    CHECK(breaks([](Clip& c) { c.bands[0].priority = 2; }));
    CHECK(breaks([](Clip& c) { c.bands[0].centreFrequency = 76.0; }));
    CHECK(breaks([](Clip& c) { c.bands[0].amplitude[0].value = 0.5; }));
    CHECK(breaks([](Clip& c) { c.bands[0].pitch[0].value = 61.0; }));
    CHECK(breaks([](Clip& c) { c.bands.push_back(c.bands[0]); }));
    CHECK(breaks([](Clip& c) { c.transients[0].sharpness = 0.25; }));
    CHECK(breaks([](Clip& c) { c.noise[0].highFrequency = 21.0; }));
    CHECK(breaks([](Clip& c) { c.noise[0].amplitude[0].value = 0.25; }));
    CHECK(breaks([](Clip& c) { c.markers[0].name = "n"; }));
    CHECK(breaks([](Clip& c) { c.markers[0].time = 0.5; }));
    CHECK(breaks([](Clip& c) { c.source.channels = 1; }));
    CHECK(breaks([](Clip& c) { c.source.file = "x"; }));
    CHECK(breaks([](Clip& c) { c.encoder[0].name = "texts"; }));
    CHECK(breaks([](Clip& c) { c.encoder[0].value = std::string("u"); }));
    CHECK(breaks([](Clip& c) { c.encoder[1].value = 2.0; }));
    CHECK(breaks([](Clip& c) { c.encoder[2].value = true; }));
    CHECK(breaks([](Clip& c) { std::get<double>(c.encoder[3].value) += 1.0; }));
    CHECK_FALSE(breaks([](Clip& c) { c.envelope[0].time = -0.0; })); // no two zeros
    Clip bare = clip;
    bare.encoder.pop_back();
    CHECK(sealOf(bare) == ClipSeal::missing);
    sealClip(bare);
    CHECK(bare == clip);
}
