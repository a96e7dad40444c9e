#include "support/Catch.h"
#include "support/ClipSamples.h"
#include "support/RandomClip.h"

#include <pacini/clip/PackedClip.h>

#include <limits>
#include <span>

using namespace pacini;

namespace
{
/// Largest difference of two curves in time, and of their values in the given measure.
void checkCurve(const Curve& a, const Curve& b, double timeStep, double step, bool level)
{
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        REQUIRE(std::abs(a[i].time - b[i].time) <= timeStep);
        const double x = a[i].value, y = b[i].value;
        if (level && (y == 0.0 || x == 0.0))
            REQUIRE(x + y < 3e-4);
        else
            REQUIRE(std::abs(std::log(x / y)) <= step);
    }
}
} // namespace

TEST_CASE("A packed clip comes back within half a step of every grid", "[clip]")
{
    for (std::uint64_t seed = 0; seed < 60; ++seed)
        for (int bits : {4, 6, 12, 16})
        {
            CAPTURE(seed, bits);
            const Clip clip = test::randomClip(seed);
            REQUIRE(validate(clip).ok());
            const auto read = unpackClip(packClip(clip, {bits, 1000}));
            REQUIRE(read.ok());
            const double levelStep = 72.0 / ((1 << bits) - 2) / 8.685889638 * 0.51;
            const double pitchStep = std::log(2.0) * 4.0 / (3.0 * (1 << bits)) * 0.51;
            CHECK(read->duration == clip.duration);
            CHECK(read->name == clip.name);
            CHECK(read->source == clip.source);
            CHECK(read->encoder == clip.encoder);
            REQUIRE(read->bands.size() == clip.bands.size());
            checkCurve(read->envelope, clip.envelope, 1e-3, levelStep, true);
            checkCurve(read->centroid, clip.centroid, 1e-3, pitchStep, false);
            for (std::size_t k = 0; k < clip.bands.size(); ++k)
            {
                checkCurve(read->bands[k].amplitude, clip.bands[k].amplitude, 1e-3, levelStep, true);
                checkCurve(read->bands[k].pitch, clip.bands[k].pitch, 1e-3, pitchStep, false);
                CHECK(read->bands[k].lowFrequency == clip.bands[k].lowFrequency);
                CHECK(read->bands[k].centreFrequency == clip.bands[k].centreFrequency);
                CHECK(read->bands[k].highFrequency == clip.bands[k].highFrequency);
                CHECK(read->bands[k].priority == clip.bands[k].priority);
            }
            REQUIRE(read->transients.size() == clip.transients.size());
            CHECK(read->noise.size() == clip.noise.size());
            CHECK(read->markers.size() == clip.markers.size());
            for (std::size_t i = 0; i < clip.markers.size(); ++i)
                CHECK(read->markers[i].name == clip.markers[i].name);
        }
}

TEST_CASE("What lies on the grids is kept exactly, and packs to the same bytes", "[clip]")
{
    for (std::uint64_t seed = 0; seed < 60; ++seed)
        for (std::uint32_t ticks : {1000u, 48000u, 7u})
        {
            CAPTURE(seed, ticks);
            const PackParams params{9, ticks};
            const auto bytes = packClip(test::randomClip(seed), params);
            const auto once = unpackClip(bytes);
            REQUIRE(once.ok());
            CHECK(packClip(*once, params) == bytes);
            const auto twice = unpackClip(packClip(*once, params));
            REQUIRE(twice.ok());
            CHECK(*twice == *once);
        }
}

TEST_CASE("A clip is rounded to its grids as packing and unpacking it does", "[clip]")
{
    const auto check = [](Clip clip, int bits)
    {
        CAPTURE(bits);
        setQuantise(clip, bits);
        REQUIRE(validate(clip).ok());
        const auto unpacked = unpackClip(packClip(clip, packParamsFor(clip)));
        REQUIRE(unpacked.ok());
        CHECK(onGrids(clip) == *unpacked);
    };
    for (const int bits : {4, 6, 8, 12, 13, 16})
    {
        for (std::uint64_t seed = 0; seed < 40; ++seed)
        {
            CAPTURE(seed);
            check(test::randomClip(seed), bits);
            check(test::randomFullClip(seed), bits);
        }
        Clip extremes;
        extremes.duration = 1.23456;
        extremes.envelope = {{0.0, 0.0}, {0.00049, 1e-9}, {0.0005, limits::amplitude}, {1.2345, 1e-4}, {1.23456, 3e-3}};
        extremes.bands = {{100.0, 150.0, 200.0, 0, {{0.0, 1e-3}, {1.23456, 0.0}}, {{0.0, 0.0015}, {1.2341, 3e5}}}};
        extremes.transients = {{1.23456, 1e-9, 1.0}};
        check(extremes, bits);
        extremes.envelope = {{0.0, 0.0}, {1.0, 0.0}};
        extremes.bands.front().amplitude = {};
        check(extremes, bits);
    }
}

TEST_CASE("Long gaps, long curves and the ends of the ranges survive packing", "[clip]")
{
    Clip clip;
    clip.duration = 3600.0;
    clip.envelope = {{0.0, 0.0}, {0.001, 1.0}, {3599.0, 0.5}, {3600.0, 0.0}};
    Band band{1.0, 300.0, 400000.0, -7, {{1800.0, 1000.0}}, {{0.0, 0.001}, {3600.0, 400000.0}}};
    clip.bands.assign(3, band);
    clip.transients = {{3600.0, 1000.0, 1.0}};
    REQUIRE(validate(clip).ok());
    const auto read = unpackClip(packClip(clip, {16, 1000}));
    REQUIRE(read.ok());
    CHECK(read->envelope.size() == 4);
    CHECK(read->envelope[2].time == 3599.0);
    CHECK(read->bands[2].amplitude[0].time == 1800.0);
    CHECK(read->bands[1].amplitude[0].value == Approx(1000.0).epsilon(1e-3));
    CHECK(read->bands[0].pitch[0].value == Approx(0.001).epsilon(1e-4));
    CHECK(read->bands[0].priority == -7);
    CHECK(read->transients[0].time == 3600.0);
}

TEST_CASE("Band layouts of the encoder cost a few bytes", "[clip]")
{
    for (const BandSpacing spacing : {BandSpacing::logarithmic, BandSpacing::linear})
    {
        Clip clip;
        clip.duration = 1.0;
        int priority = 0;
        for (const BandEdges& edges : tiledBands(12, 30.0, 1000.0, spacing))
            clip.bands.push_back({edges.low, edges.centre, edges.high, priority++, {}, {}});
        const auto bytes = packClip(clip);
        CHECK(bytes.size() < 32);
        REQUIRE(unpackClip(bytes).ok());
        CHECK(unpackClip(bytes)->bands == clip.bands);
    }
}

TEST_CASE("Foreign, newer, cut and damaged packed files are errors with their reason", "[clip]")
{
    const auto bytes = packClip(test::randomClip(3));
    const auto codeOf = [](std::vector<std::byte> data)
    {
        const auto result = unpackClip(data);
        REQUIRE_FALSE(result.ok());
        return result.error().code;
    };
    CHECK(codeOf({}) == ErrorCode::invalidData);
    CHECK(codeOf({std::byte{'P'}, std::byte{'A'}}) == ErrorCode::invalidData);
    CHECK(codeOf({bytes.begin(), bytes.begin() + 5}) == ErrorCode::truncated);
    auto newer = bytes;
    newer[4] = std::byte{3};
    CHECK(codeOf(newer) == ErrorCode::unsupportedVersion);
    CHECK(unpackClip(newer).error().message.find("newer version (3)") != std::string::npos);
    for (std::size_t cut = 7; cut < bytes.size(); cut += 11)
        CHECK(codeOf({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(cut)}) == ErrorCode::invalidData);
    for (std::size_t at = 5; at < bytes.size(); at += 13)
    {
        auto damaged = bytes;
        damaged[at] ^= std::byte{0x10};
        CHECK(codeOf(damaged) == ErrorCode::invalidData);
    }
    auto longer = bytes;
    longer.push_back(std::byte{1});
    CHECK(codeOf(longer) == ErrorCode::invalidData);
}

TEST_CASE("Nonsense behind a valid checksum never gives an invalid clip", "[clip]")
{
    Random random(17);
    int valid = 0;
    for (int run = 0; run < 3000; ++run)
    {
        std::vector<std::byte> payload(static_cast<std::size_t>(random.uniform(0.0, 60.0)));
        for (auto& b : payload)
            b = static_cast<std::byte>(random.next() & 0xFF);
        const auto bytes = detail::withHeader(payload);
        const auto result = unpackClip(bytes);
        if (result.ok())
        {
            ++valid;
            REQUIRE(validate(*result).ok());
        }
    }
    // A fifth happens to be a clip: the claim is about those.
    CHECK(valid > 300);
    CHECK(valid < 3000);
}

TEST_CASE("Flipped bits behind a valid checksum never give an invalid clip", "[clip]")
{
    Random random(18);
    int valid = 0, changed = 0;
    for (std::uint64_t run = 0; run < 1000; ++run)
    {
        CAPTURE(run);
        const auto bytes = packClip(test::randomClip(run % 40));
        std::vector<std::byte> payload(bytes.begin() + static_cast<std::ptrdiff_t>(detail::withHeader({}).size()),
                                       bytes.end());
        for (auto flips = 1 + random.next() % 3; flips > 0; --flips)
            payload[random.next() % payload.size()] ^= static_cast<std::byte>(1u << (random.next() % 8));
        const auto result = unpackClip(detail::withHeader(payload));
        if (!result.ok())
            continue;
        ++valid;
        changed += *result == *unpackClip(bytes) ? 0 : 1;
        REQUIRE(validate(*result).ok());
    }
    CHECK(valid > 300);
    CHECK(valid < 1000);
    CHECK(changed > 300);
}

TEST_CASE("Long texts survive packing, and too much text is refused instead of cut", "[clip]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.name = std::string(75000, 'a') + std::string(25000, '=');
    clip.markers = {{0.5, std::string(100000, '\n')}};
    REQUIRE(validate(clip).ok());
    const auto back = unpackClip(packClip(clip));
    REQUIRE(back.ok());
    CHECK(back->name == clip.name);
    CHECK(back->markers == clip.markers);
    clip.markers[0].name.resize(175000, 'b');
    CHECK(validate(clip).error().code == ErrorCode::tooLarge);
}

TEST_CASE("Curves that repeat themselves for very long come back from their few bytes", "[clip]")
{
    Clip clip;
    clip.duration = 3000.0;
    for (std::size_t i = 0; i < 250000; ++i)
        clip.envelope.push_back({0.01 * static_cast<double>(i), 1.0});
    const auto packed = packClip(clip, {6, 1000});
    CHECK(packed.size() < 10000);
    const auto back = unpackClip(packed);
    REQUIRE(back.ok());
    CHECK(back->envelope.size() == clip.envelope.size());
    CHECK(packClip(*back, {6, 1000}) == packed);
}

TEST_CASE("A byte of a packed clip holds 64 points at most, and more than 512 beyond that are not believed", "[clip]")
{
    const std::size_t leastBytes = 4000, points = 64 * leastBytes;
    Clip clip;
    clip.duration = 3000.0;
    for (std::size_t i = 0; i < points + 63; ++i)
        clip.envelope.push_back({0.01 * static_cast<double>(i), 1.0});
    const auto headed = detail::packedHeaderBytes;
    CHECK(packClip(clip).size() == headed + leastBytes);
    clip.envelope.resize(points - 1);
    CHECK(packClip(clip).size() == headed + leastBytes - 1);
    clip.envelope.push_back({0.01 * static_cast<double>(points - 1), 1.0});
    const auto packed = packClip(clip);
    REQUIRE(packed.size() == headed + leastBytes);
    const auto whole = unpackClip(packed);
    REQUIRE(whole.ok());
    CHECK(whole->envelope.size() == points);
    // What fills it up is zeros, which may be missing.
    const auto ofBytes = [&](std::size_t count)
    {
        return unpackClip(detail::withHeader(std::span(packed).subspan(headed, count)));
    };
    const auto enough = ofBytes(leastBytes - 7);
    REQUIRE(enough.ok());
    CHECK(*enough == *whole);
    for (const std::size_t count : {leastBytes - 8, leastBytes - 9, leastBytes - 100})
    {
        CAPTURE(count);
        const auto tooFew = ofBytes(count);
        REQUIRE_FALSE(tooFew.ok());
        CHECK(tooFew.error().text() == "contents: are invalid: the file is damaged");
    }
}

TEST_CASE("Markers beside curves that repeat themselves for very long are all kept", "[clip]")
{
    Clip clip;
    clip.duration = 3000.0;
    for (std::size_t i = 0; i < 250000; ++i)
        clip.envelope.push_back({0.01 * static_cast<double>(i), 1.0});
    for (int i = 0; i < 2000; ++i)
        clip.markers.push_back({static_cast<double>(i), ""});
    const auto read = unpackClip(packClip(clip));
    REQUIRE(read.ok());
    CHECK(read->markers == clip.markers);
}
