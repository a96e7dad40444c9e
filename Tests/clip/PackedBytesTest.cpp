#include "support/Catch.h"
#include "support/ClipSamples.h"
#include "support/Pinned.h"
#include "support/RandomClip.h"

#include <pacini/clip/PackedClip.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace pacini;

namespace
{

/// A number of 32 bits that nearly every change of the bytes changes (FNV-1a).
double packedHash(std::span<const std::byte> bytes)
{
    std::uint32_t hash = 2166136261u;
    for (const std::byte b : bytes)
        hash = (hash ^ static_cast<std::uint32_t>(b)) * 16777619u;
    return static_cast<double>(hash);
}

/// A clip whose curves are on the grids of `params` and its packed bytes.
void addPacked(std::vector<double>& all, const Clip& clip, const PackParams& params)
{
    const auto bytes = packClip(clip, params);
    all.push_back(static_cast<double>(bytes.size()));
    all.push_back(packedHash(bytes));
    const auto back = unpackClip(bytes);
    REQUIRE(back.ok());
    CHECK(packClip(*back, params) == bytes);
}

/// Like what the encoder makes: bands side by side, attacks that hit all at once, decays, moving pitches.
Clip packedMusic(std::size_t bandCount, std::uint64_t seed)
{
    Random random(seed);
    Clip clip;
    clip.duration = 6.0;
    clip.name = "music_loop";
    clip.source = {"music_loop.wav", 44100.0, 2};
    clip.encoder = {{"method", std::string("a2vt")}, {"quantise", 6.0}, {"gain", 0.5}, {"loop", true}};
    for (std::size_t k = 0; k < bandCount; ++k)
    {
        const double low = 20.0 * std::pow(1.5, static_cast<double>(k));
        clip.bands.push_back({std::round(low), std::round(1.2 * low), std::round(1.5 * low), 0, {}, {}});
    }
    double time = 0.0;
    while (time < 5.5)
    {
        const double level = random.uniform(0.1, 1.0);
        clip.envelope.push_back({time, 0.0});
        clip.envelope.push_back({time + 0.004, level});
        clip.envelope.push_back({time + 0.15, 0.3 * level});
        clip.transients.push_back({time, level, random.uniform()});
        for (Band& band : clip.bands)
        {
            const double own = level * random.uniform(0.2, 0.8);
            band.amplitude.push_back({time, 0.0});
            band.amplitude.push_back({time + 0.004, own});
            band.amplitude.push_back({time + random.uniform(0.05, 0.15), 0.5 * own});
            band.pitch.push_back({time, band.centreFrequency * random.uniform(0.9, 1.1)});
        }
        clip.centroid.push_back({time, random.uniform(100.0, 400.0)});
        time += 0.2 + 0.1 * random.uniform();
    }
    int rank = 0;
    std::vector<double> energies;
    for (const Band& band : clip.bands)
        energies.push_back(curveEnergy(band.amplitude, clip.duration));
    const auto ranks = prioritiesByEnergy(energies);
    for (Band& band : clip.bands)
        band.priority = ranks[static_cast<std::size_t>(rank++)];
    clip.noise = {{50.0, 900.0, {{0.0, 0.01}, {3.0, 0.02}, {6.0, 0.0}}}, {900.0, 1000.5, {{1.0, 0.3}}}};
    clip.markers = {{0.5, "verse"}, {2.0, "refrain = 1"}, {6.0, "end"}};
    return clip;
}

} // namespace

// The format of version 1 is fixed: what is written today must have the same bytes tomorrow.
TEST_CASE("Packed clips have the pinned bytes", "[clip]")
{
    for (const int bits : {4, 6, 9, 12, 16})
    {
        std::vector<double> random, full, music;
        const PackParams params{bits, bits == 9 ? 44100u : 1000u};
        for (std::uint64_t seed = 0; seed < 12; ++seed)
            addPacked(random, test::randomClip(100 + seed), params);
        for (std::uint64_t seed = 0; seed < 6; ++seed)
        {
            addPacked(full, onGrids(test::randomFullClip(seed)), params);
            addPacked(music, packedMusic(seed + 1, seed), params);
            addPacked(music, packedMusic(seed + 1, seed), {bits, 173});
        }
        checkPinned("clip/bytes of random clips, " + std::to_string(bits) + " bits", random, 1e-10);
        checkPinned("clip/bytes of full clips, " + std::to_string(bits) + " bits", full, 1e-10);
        checkPinned("clip/bytes of music, " + std::to_string(bits) + " bits", music, 1e-10);
    }
}

TEST_CASE("Curves of every shape have the pinned bytes", "[clip]")
{
    const auto bytesOf =
        [](const Curve& envelope, const std::vector<Curve>& amplitudes, double duration, PackParams params = {6, 1000})
    {
        Clip clip;
        clip.duration = duration;
        clip.envelope = envelope;
        for (const Curve& amplitude : amplitudes)
            clip.bands.push_back({100.0, 150.0, 200.0, 0, amplitude, {}});
        std::vector<double> all;
        addPacked(all, clip, params);
        return all;
    };
    std::vector<double> all;
    const auto add = [&](const std::vector<double>& more)
    {
        all.insert(all.end(), more.begin(), more.end());
    };
    add(bytesOf({}, {}, 0.0));
    add(bytesOf({}, {{}}, 1.0));
    add(bytesOf({{0.0, 0.5}}, {{{0.0, 0.25}}, {{0.0, 0.5}}}, 1.0));
    add(bytesOf({{0.3, 0.5}}, {{{0.3, 0.5}}}, 1.0));
    add(bytesOf({{0.0, 0.5}, {1.0, 0.5}}, {{{0.0, 0.5}, {1.0, 0.0}}}, 1.0));
    Curve even, sparse, dense, stepped;
    for (int i = 0; i <= 100; ++i)
        even.push_back({0.01 * i, 0.5 + 0.4 * std::sin(0.3 * i)});
    for (int i = 0; i <= 10; ++i)
        sparse.push_back({0.1 * i * i, i % 2 == 0 ? 0.9 : 0.01});
    for (int i = 0; i <= 1000; ++i)
        dense.push_back({0.001 * i, 0.5 + 0.4 * std::cos(0.01 * i)});
    for (int i = 0; i < 20; ++i)
        stepped.insert(stepped.end(), {{0.05 * i, 0.1 + 0.02 * i}, {0.05 * i, 0.9 - 0.03 * i}});
    checkPinned("clip/bytes of short curves", all, 1e-10);
    all.clear();
    add(bytesOf(even, {even, sparse}, 10.0));
    add(bytesOf(even, {even}, 1.0));
    add(bytesOf(dense, {even, even}, 1.0));
    add(bytesOf(dense, {dense, even}, 1.0, {16, 1000000}));
    add(bytesOf(stepped, {even, stepped, stepped}, 1.0));
    add(bytesOf(sparse, {sparse, dense}, 200.0));
    add(bytesOf({}, {stepped, even}, 1.0, {9, 1}));
    add(bytesOf({}, {stepped, even}, 1.0, {9, 7}));
    // Gaps of 64 steps, and of one more, are coded in different ways.
    for (const int gap : {63, 64, 65, 66})
        add(bytesOf({{0.0, 1.0}, {0.001 * gap, 0.5}, {0.001 * (gap + 1), 0.7}, {0.2, 0.1}}, {}, 0.2));
    checkPinned("clip/bytes of curves", all, 1e-10);
}

TEST_CASE("Numbers and texts have the pinned bytes", "[clip]")
{
    std::vector<double> all;
    const auto add = [&](const Clip& clip)
    {
        addPacked(all, clip, {});
    };
    for (const double rate : {0.0, 8000.0, 22050.0, 32000.0, 44100.0, 48000.0, 96000.0, 192000.0, 11025.0, 44100.5})
        for (const double duration : {0.0, 1.0, 1.0 / 3.0})
        {
            Clip clip;
            clip.duration = duration;
            clip.source.sampleRate = rate;
            clip.source.channels = static_cast<int>(rate) % 7;
            add(clip);
            CHECK(unpackClip(packClip(clip))->source == clip.source);
            CHECK(unpackClip(packClip(clip))->duration == duration);
        }
    checkPinned("clip/bytes of sources", all, 1e-10);
    all.clear();
    for (const char* text : {"", "a", "Metal Impact 02.wav", "knock_wood_window.wav", "x.y.z", ".wav", "no dot",
                             "\x01\x02=\n\t", "h\xC3\xA4mmer"})
    {
        Clip clip;
        clip.source.file = text;
        clip.name = detail::fileStem(text);
        clip.encoder = {{text, std::string(text)}, {"other", -1.5e-7}, {"no", false}, {"yes", true}};
        add(clip);
        CHECK(*unpackClip(packClip(clip)) == clip);
        clip.name = std::string("other ") + text;
        clip.encoder.clear();
        add(clip);
        CHECK(*unpackClip(packClip(clip)) == clip);
    }
    checkPinned("clip/bytes of texts", all, 1e-10);
    all.clear();
    for (const double low : {1.0, 30.0, 1048575.0 / 4.0, 0.1, 99.5})
        for (const double high : {400000.0, 300000.25})
            for (const int priority : {0, 1, -1, 1000000, std::numeric_limits<int>::min()})
            {
                Clip clip;
                clip.bands = {{low, low, high, priority, {}, {}}, {low, high, high, priority, {}, {}}};
                add(clip);
                CHECK(unpackClip(packClip(clip))->bands == clip.bands);
            }
    for (const BandSpacing spacing : {BandSpacing::logarithmic, BandSpacing::linear})
        for (const std::size_t count : {1u, 2u, 12u, 256u})
        {
            Clip clip;
            int priority = 0;
            for (const BandEdges& edges : tiledBands(count, 30.5, 1000.0, spacing))
                clip.bands.push_back({edges.low, edges.centre, edges.high, priority++, {}, {}});
            add(clip);
            CHECK(unpackClip(packClip(clip))->bands == clip.bands);
        }
    checkPinned("clip/bytes of bands", all, 1e-10);
}

TEST_CASE("Adaptive bits and numbers have the pinned odds and bytes", "[clip]")
{
    std::vector<double> odds;
    for (const double guess : {0.0, 0.0001, 0.03, 0.5, 0.97, 1.0})
        for (const int weight : {0, 1, 5, 62, 63})
        {
            AdaptiveBit bit(guess, weight);
            for (int i = 0; i < 90; ++i)
            {
                odds.push_back(static_cast<double>(bit.ones()));
                bit.update(i % 3 == 0 || i > 70);
            }
        }
    checkPinned("clip/odds", odds, 1e-10);
    AdaptiveBit ones, zeros;
    for (int i = 0; i < 2000; ++i)
    {
        ones.update(true);
        zeros.update(false);
    }
    CHECK(AdaptiveBit().ones() == 32768);
    CHECK(AdaptiveBit(0.0).ones() == 48);
    CHECK(AdaptiveBit(1.0).ones() == 65488);
    CHECK(AdaptiveBit(48.0 / 65536.0).ones() == 48);
    CHECK(AdaptiveBit(65488.0 / 65536.0).ones() == 65488);
    CHECK(AdaptiveBit(65487.0 / 65536.0).ones() == 65487);
    CHECK(ones.ones() > 65400);
    CHECK(zeros.ones() < 130);
    std::vector<double> hashes;
    for (const double typical : {0.0, 0.1, 1.0, 1.3, 1.4, 8.0, 300.0, 1e6})
    {
        RangeWriter writer;
        AdaptiveNumber plain(typical);
        AdaptiveSignedNumber both(typical);
        AdaptiveBit sign(0.2, 3);
        for (std::int64_t i = 0; i < 60; ++i)
        {
            plain.code(writer, static_cast<std::uint64_t>(i * i));
            both.code(writer, (i - 30) * i);
            both.code(writer, 20 - i, sign);
        }
        for (const std::uint64_t large : {std::uint64_t{1} << 20, (std::uint64_t{1} << 40) - 2})
            plain.code(writer, large);
        const auto bytes = writer.finish();
        hashes.push_back(static_cast<double>(bytes.size()));
        hashes.push_back(packedHash(bytes));
    }
    checkPinned("clip/bytes of numbers", hashes, 1e-10);
    RangeWriter first;
    AdaptiveNumber number;
    number.code(first, 5);
    RangeWriter second;
    AdaptiveNumber typicalOfOne(1.0);
    typicalOfOne.code(second, 5);
    CHECK(first.finish() == second.finish());
}

TEST_CASE("An empty range code is no bytes, and trailing zeros are left out and read again", "[clip]")
{
    CHECK(RangeWriter().finish().empty());
    for (int ones = 0; ones < 40; ++ones)
    {
        RangeWriter writer;
        for (int i = 0; i < 40; ++i)
            writer.bit(i < ones);
        const auto bytes = writer.finish();
        CHECK((bytes.empty() || bytes.back() != std::byte{0}));
        CHECK(bytes.size() <= 6);
        RangeReader reader(bytes);
        for (int i = 0; i < 40; ++i)
            CHECK(reader.bit(false) == (i < ones));
    }
    std::vector<double> lengths;
    for (int n = 0; n < 24; ++n)
    {
        RangeWriter writer;
        for (int i = 0; i < n; ++i)
            writer.bit(i % 5 < 2);
        lengths.push_back(packedHash(writer.finish()));
    }
    checkPinned("clip/bytes of even bits", lengths, 1e-10);
}

TEST_CASE("The checksum is CRC-16 CCITT, behind the magic and the version", "[clip]")
{
    std::vector<std::byte> text;
    for (const char c : std::string("123456789"))
        text.push_back(static_cast<std::byte>(c));
    CHECK(detail::crc16(text) == 0x29B1); // the check value of CRC-16/CCITT-FALSE
    CHECK(detail::crc16({}) == 0xFFFF);
    const auto bytes = detail::withHeader(text);
    REQUIRE(bytes.size() == 16);
    CHECK(bytes[0] == std::byte{'P'});
    CHECK(bytes[1] == std::byte{'A'});
    CHECK(bytes[2] == std::byte{'C'});
    CHECK(bytes[3] == std::byte{'B'});
    CHECK(bytes[4] == std::byte{1});
    CHECK(bytes[5] == std::byte{0x29});
    CHECK(bytes[6] == std::byte{0xB1});
    CHECK(bytes[7] == std::byte{'1'});
    const auto messageOf = [](std::vector<std::byte> data)
    {
        const auto result = unpackClip(data);
        REQUIRE_FALSE(result.ok());
        return result.error().where + ": " + result.error().message;
    };
    CHECK(messageOf({}) == "header: is not a packed Pacini clip");
    CHECK(messageOf({bytes.begin(), bytes.begin() + 3}) == "header: is not a packed Pacini clip");
    CHECK(messageOf({bytes.begin(), bytes.begin() + 4}) == "header: ends too early");
    CHECK(messageOf({bytes.begin(), bytes.begin() + 6}) == "header: ends too early");
    CHECK(messageOf({bytes.begin(), bytes.begin() + 7}) ==
          "checksum: does not match: the file is damaged or truncated");
    auto other = bytes;
    other[0] = std::byte{'Q'};
    CHECK(messageOf(other) == "header: is not a packed Pacini clip");
    other = bytes;
    other[4] = std::byte{9};
    CHECK(messageOf(other) == "header: was written by a newer version (9) of the format; this program reads version 2");
    other = bytes;
    other[5] ^= std::byte{1};
    CHECK(messageOf(other) == "checksum: does not match: the file is damaged or truncated");
    other = bytes;
    other[6] ^= std::byte{1};
    CHECK(messageOf(other) == "checksum: does not match: the file is damaged or truncated");
    CHECK(messageOf(detail::withHeader(std::vector<std::byte>(40, std::byte{0xAB}))) ==
          "contents: are invalid: the file is damaged");
}

TEST_CASE("The grids are those that the clip names, within their limits", "[clip]")
{
    CHECK(PackParams{}.bits == 12);
    CHECK(PackParams{}.ticksPerSecond == 1000);
    Clip clip;
    CHECK(packParamsFor(clip) == PackParams{});
    CHECK(packParamsFor(clip, {7, 3}) == PackParams{7, 3});
    setQuantise(clip, 6);
    CHECK(clip.encoder == std::vector<EncoderParameter>{{"quantise", 6.0}});
    CHECK(packParamsFor(clip, {7, 3}) == PackParams{6, 3});
    clip.encoder.insert(clip.encoder.begin(), {"other", 1.0});
    for (const auto& [asked, given] : {std::pair(4, 4), {3, 4}, {-9, 4}, {16, 16}, {17, 16}, {11, 11}})
    {
        setQuantise(clip, asked);
        CHECK(clip.encoder.size() == 2);
        CHECK(packParamsFor(clip).bits == given);
    }
    clip.encoder[1].value = std::string("8");
    CHECK(packParamsFor(clip) == PackParams{});
    // Parameters out of range are clamped.
    const Clip some = test::randomClip(1);
    CHECK(packClip(some, {3, 1000}) == packClip(some, {4, 1000}));
    CHECK(packClip(some, {17, 1000}) == packClip(some, {16, 1000}));
    CHECK(packClip(some, {5, 1000}) != packClip(some, {4, 1000}));
    CHECK(packClip(some, {15, 1000}) != packClip(some, {16, 1000}));
    CHECK(packClip(some, {8, 0}) == packClip(some, {8, 1}));
    CHECK(packClip(some, {8, 2}) != packClip(some, {8, 1}));
    CHECK(packClip(some, {8, 1000001}) == packClip(some, {8, 1000000}));
    CHECK(packClip(some, {8, 999999}) != packClip(some, {8, 1000000}));
}

TEST_CASE("The faintest level, minus zero and the longest duration survive packing", "[clip]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.envelope = {{0.0, 1.0}, {0.5, std::pow(10.0, -72.0 / 20.0)}, {1.0, 0.0}};
    clip.bands = {{-0.0, 1048575.0 / 4.0, 300000.0, 0, {{0.0, std::pow(10.0, -72.0 / 20.0)}}, {}}};
    const auto back = unpackClip(packClip(clip, {6, 1000}));
    REQUIRE(back.ok());
    CHECK(back->envelope[1].value == Approx(std::pow(10.0, -72.0 / 20.0)).epsilon(1e-3));
    CHECK(back->envelope[2].value == 0.0);
    CHECK(back->bands[0].amplitude[0].value == Approx(std::pow(10.0, -72.0 / 20.0)).epsilon(1e-3));
    CHECK(std::signbit(back->bands[0].lowFrequency));
    for (const double value : {0.0, 1.0, 1048575.0, 0.5})
    {
        clip.bands[0].lowFrequency = clip.bands[0].centreFrequency = std::min(value, 300000.0);
        CHECK(unpackClip(packClip(clip))->bands[0].lowFrequency == clip.bands[0].lowFrequency);
    }
    clip.duration = 86400.0;
    CHECK(unpackClip(packClip(clip))->duration == 86400.0);
}

TEST_CASE("Contents that no clip can have are damage", "[clip]")
{
    const auto refused = [](const Clip& clip)
    {
        const auto back = unpackClip(packClip(clip));
        REQUIRE_FALSE(back.ok());
        return back.error().text();
    };
    const std::string damaged = "contents: are invalid: the file is damaged";
    for (const double duration : {-1.0, 86400.1, std::nan(""), std::numeric_limits<double>::infinity()})
    {
        Clip clip;
        clip.duration = duration;
        CHECK(refused(clip) == damaged);
    }
    Clip many;
    many.bands.resize(257);
    CHECK(refused(many) == damaged);
    many.bands.resize(256);
    CHECK(unpackClip(packClip(many)).ok());
    Clip noisy;
    noisy.noise.resize(257);
    CHECK(refused(noisy) == damaged);
    noisy.noise.resize(256);
    CHECK(unpackClip(packClip(noisy)).ok());
}
