#include "support/Catch.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/synthesis/LoopUnroll.h>
#include <pacini/synthesis/VariationSeed.h>
#include <pacini/synthesis/VoiceLimit.h>
#include <pacini/synthesis/VoiceMerge.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
Band voiceBand(double hertz, double level, int priority = 0)
{
    return {hertz / 2.0, hertz, hertz * 2.0, priority, {{0.0, level}}, {{0.0, hertz}}};
}

std::vector<double> numbersOf(const Clip& clip)
{
    std::vector<double> all;
    const auto add = [&](const Curve& curve)
    {
        all.push_back(static_cast<double>(curve.size()));
        for (const Breakpoint& point : curve)
        {
            all.push_back(point.time);
            all.push_back(point.value);
        }
    };
    all.push_back(clip.duration);
    add(clip.envelope);
    add(clip.centroid);
    for (const Band& band : clip.bands)
    {
        for (const double v : {band.lowFrequency, band.centreFrequency, band.highFrequency, double(band.priority)})
            all.push_back(v);
        add(band.amplitude);
        add(band.pitch);
    }
    for (const NoiseBand& band : clip.noise)
        add(band.amplitude);
    for (const Transient& event : clip.transients)
        for (const double v : {event.time, event.amplitude, event.sharpness})
            all.push_back(v);
    return all;
}
} // namespace

TEST_CASE("Voices are served by priority, then power, then index, as far as they last", "[adaptation]")
{
    using Losses = std::vector<VoiceLoss>;
    // The same time for all: 3 voices.
    const std::vector<VoiceClaim> claims = {{0.0, 1.0, 2, 1, 0.5},
                                            {0.0, 1.0, 2, 0, 0.1},
                                            {0.0, 1.0, 1, 1, 0.4},
                                            {0.0, 1.0, 1, 1, 0.6},
                                            {0.0, 1.0, 0, 9, 0.0}};
    const Losses all{{0.0, 1.0}};
    {
        const auto losses = voiceLosses(claims, 3);
        CHECK(losses == std::vector<Losses>{all, {}, all, {}, {}});
    }
    {
        const auto losses =
            voiceLosses(claims, 4); // priority 0 takes two, the strongest of priority 1 one, the next needs two
        CHECK(losses == std::vector<Losses>{all, {}, {}, {}, {}});
    }
    CHECK(voiceLosses(claims, 0) == std::vector<Losses>{all, all, all, all, {}});
    CHECK(voiceLosses(claims, 5) == std::vector<Losses>{{}, {}, all, {}, {}});
    CHECK(voiceLosses(claims, 6) == std::vector<Losses>(5));
    CHECK(voiceLosses({}, 1).empty());
    // Of equals the first.
    CHECK(voiceLosses(std::vector<VoiceClaim>(2, {0.0, 1.0, 1, 0, 0.5}), 1) == std::vector<Losses>{{}, all});
    const VoiceClaim usual;
    CHECK(test::asNumbers(usual.from, usual.to, usual.voices, usual.priority, usual.power) ==
          test::Numbers{0.0, 0.0, 1, 0, 0.0});
    const VoiceLoss none;
    CHECK(none.from == 0.0);
    CHECK(none.to == 0.0);
}

TEST_CASE("A loss is one as long as it lasts, and over when a voice is free", "[adaptation]")
{
    using Losses = std::vector<VoiceLoss>;
    // The weak one waits through two strong ones that follow each other, has a pause, and waits again.
    const std::vector<VoiceClaim> claims = {{0.0, 6.0, 1, 0, 0.1},
                                            {1.0, 2.0, 1, 0, 0.5},
                                            {2.0, 3.0, 1, 0, 0.5},
                                            {4.0, 5.0, 1, 0, 0.5},
                                            {2.5, 2.7, 1, 0, 0.01}};
    CHECK(voiceLosses(claims, 1) == std::vector<Losses>{{{1.0, 3.0}, {4.0, 5.0}}, {}, {}, {}, {{2.5, 2.7}}});
    // What ends when another begins frees its voice.
    CHECK(voiceLosses(std::vector<VoiceClaim>{{0.0, 1.0}, {1.0, 2.0}}, 1) == std::vector<Losses>(2));
    // Nothing lasts no time at all.
    CHECK(voiceLosses(std::vector<VoiceClaim>{{0.5, 0.5}, {0.0, 1.0, 1, 5, 0.0}}, 1) == std::vector<Losses>(2));
}

TEST_CASE("A gain without a voice fades within 5 ms on both sides of the loss", "[adaptation]")
{
    const Curve gain = {{0.0, 1.0}, {1.0, 1.0}, {2.0, 0.5}, {3.0, 0.5}, {4.0, 1.0}};
    const std::vector<VoiceLoss> losses = {{1.0, 1.5}, {2.0, 3.0}, {3.5, 3.506}};
    const Curve gated = withoutVoice(gain, losses);
    const Curve wanted = {{0.0, 1.0},   {1.0, 1.0},   {1.005, 0.0},   {1.495, 0.0}, {1.5, 0.75},
                          {2.0, 0.5},   {2.005, 0.0}, {2.995, 0.0},   {3.0, 0.5},   {3.5, 0.75},
                          {3.503, 0.0}, {3.503, 0.0}, {3.506, 0.753}, {4.0, 1.0}};
    REQUIRE(gated.size() == wanted.size());
    for (std::size_t i = 0; i < gated.size(); ++i)
    {
        CAPTURE(i);
        CHECK(gated[i].time == Approx(wanted[i].time));
        CHECK(gated[i].value == Approx(wanted[i].value).margin(1e-12));
    }
    CHECK(withoutVoice(gain, {}) == gain);
    // A loss of exactly two fades, one after the last point, and one before the first.
    const Curve late = withoutVoice({{1.0, 2.0}}, std::vector<VoiceLoss>{{0.5, 0.51}, {5.0, 6.0}});
    const Curve wantedLate = {{0.5, 2.0}, {0.505, 0.0}, {0.505, 0.0}, {0.51, 2.0}, {1.0, 2.0},
                              {5.0, 2.0}, {5.005, 0.0}, {5.995, 0.0}, {6.0, 2.0}};
    REQUIRE(late.size() == wantedLate.size());
    for (std::size_t i = 0; i < late.size(); ++i)
    {
        CHECK(late[i].time == Approx(wantedLate[i].time));
        CHECK(late[i].value == Approx(wantedLate[i].value).margin(1e-12));
    }
}

TEST_CASE("The times of two curves are joined in order, once each", "[adaptation]")
{
    CHECK(detail::joinedTimes({{0.5, 1.0}, {1.0, 1.0}, {1.0, 2.0}}, {{0.0, 1.0}, {1.0, 1.0}, {2.0, 1.0}}) ==
          std::vector<double>{0.0, 0.5, 1.0, 2.0});
    CHECK(detail::joinedTimes({}, {}).empty());
}

TEST_CASE("A merged band has the power of both and the mean pitch in octaves, weighted by power", "[adaptation]")
{
    const Band a{50.0, 100.0, 150.0, 3, {{0.0, 0.3}, {1.0, 0.6}}, {{0.2, 90.0}, {0.8, 110.0}}};
    const Band b{120.0, 200.0, 300.0, 2, {{0.5, 0.4}, {0.7, 0.0}}, {}};
    for (const bool turned : {false, true})
    {
        const Band merged = turned ? detail::mergedBand(b, a) : detail::mergedBand(a, b);
        CHECK(merged.lowFrequency == 50.0);
        CHECK(merged.centreFrequency == Approx(std::sqrt(20000.0)));
        CHECK(merged.highFrequency == 300.0);
        CHECK(merged.priority == 2);
        const std::vector<double> times = {0.0, 0.2, 0.5, 0.7, 0.8, 1.0};
        REQUIRE(merged.amplitude.size() == times.size());
        REQUIRE(merged.pitch.size() == times.size());
        for (std::size_t i = 0; i < times.size(); ++i)
        {
            const double x = valueAt(a.amplitude, times[i]), y = valueAt(b.amplitude, times[i]);
            const double share = x * x / (x * x + y * y);
            CHECK(merged.amplitude[i].time == times[i]);
            CHECK(merged.pitch[i].time == times[i]);
            CHECK(merged.amplitude[i].value == Approx(std::sqrt(x * x + y * y)));
            CHECK(merged.pitch[i].value ==
                  Approx(std::pow(valueAt(a.pitch, times[i]), share) * std::pow(200.0, 1.0 - share)));
        }
    }
    // Where neither sounds the pitch is in the middle.
    const Band silent = detail::mergedBand(voiceBand(100.0, 0.0), voiceBand(400.0, 0.0));
    CHECK(silent.amplitude == Curve{{0.0, 0.0}});
    CHECK(silent.pitch[0].value == Approx(200.0));
}

TEST_CASE("The band of the highest priority number joins first, then the weakest, to its nearest neighbour",
          "[adaptation]")
{
    const auto centres = [](std::vector<Band> bands, std::size_t voices)
    {
        Clip clip;
        clip.duration = 1.0;
        clip.bands = std::move(bands);
        mergeVoices(clip, voices);
        std::vector<double> found;
        for (const Band& band : clip.bands)
            found.push_back(std::round(band.centreFrequency));
        return found;
    };
    // In order of frequency whatever came first, and left alone where there are voices for all.
    CHECK(centres({voiceBand(400.0, 0.1), voiceBand(100.0, 0.2)}, 2) == std::vector<double>{100.0, 400.0});
    CHECK(centres({voiceBand(400.0, 0.1), voiceBand(100.0, 0.2)}, 1) == std::vector<double>{200.0});
    CHECK(centres({voiceBand(400.0, 0.1), voiceBand(100.0, 0.2)}, 0) == std::vector<double>{200.0});
    CHECK(centres({}, 1).empty());
    // The lowest and the highest have one neighbour.
    CHECK(centres({voiceBand(100.0, 0.1), voiceBand(200.0, 0.5), voiceBand(250.0, 0.5)}, 2) ==
          std::vector<double>{141.0, 250.0});
    CHECK(centres({voiceBand(100.0, 0.5), voiceBand(110.0, 0.5), voiceBand(440.0, 0.1)}, 2) ==
          std::vector<double>{100.0, 220.0});
    // One in between takes the nearer in octaves, the lower of two as near.
    CHECK(centres({voiceBand(100.0, 0.5), voiceBand(150.0, 0.1), voiceBand(216.0, 0.5)}, 2) ==
          std::vector<double>{100.0, 180.0});
    CHECK(centres({voiceBand(100.0, 0.5), voiceBand(150.0, 0.1), voiceBand(240.0, 0.5)}, 2) ==
          std::vector<double>{122.0, 240.0});
    CHECK(centres({voiceBand(100.0, 0.5), voiceBand(200.0, 0.1), voiceBand(400.0, 0.5)}, 2) ==
          std::vector<double>{141.0, 400.0});
    // Priority goes before energy, energy decides between equals, and of equals the lowest joins.
    CHECK(centres({voiceBand(100.0, 0.1, 0), voiceBand(200.0, 0.5, 1), voiceBand(390.0, 0.3, 0)}, 2) ==
          std::vector<double>{100.0, 279.0});
    CHECK(centres({voiceBand(100.0, 0.3, 1), voiceBand(200.0, 0.3, 1), voiceBand(390.0, 0.2, 1)}, 2) ==
          std::vector<double>{100.0, 279.0});
    CHECK(centres({voiceBand(100.0, 0.3), voiceBand(200.0, 0.3), voiceBand(390.0, 0.3)}, 2) ==
          std::vector<double>{141.0, 390.0});
    // What has joined is as strong as both: the next to join is the 500 Hz.
    CHECK(centres({voiceBand(100.0, 0.4), voiceBand(110.0, 0.4), voiceBand(1000.0, 0.5), voiceBand(2000.0, 9.0)}, 2) ==
          std::vector<double>{105.0, 1414.0});
    // And what has not joined keeps its own energy.
    CHECK(centres({voiceBand(100.0, 0.1), voiceBand(110.0, 0.1), voiceBand(1000.0, 3.0), voiceBand(2000.0, 1.0)}, 2) ==
          std::vector<double>{324.0, 2000.0});
}

TEST_CASE("A pass of a loop begins and ends with the values of the curve there", "[scene]")
{
    const Curve pass = {{0.0, 1.0}, {0.2, 3.0}, {0.5, 6.0}, {1.0, 1.0}};
    Curve curve;
    detail::appendPass(curve, pass, 0.5, 2.0);
    CHECK(curve == Curve{{2.0, 1.0}, {2.2, 3.0}, {2.5, 6.0}});
    detail::appendPass(curve, pass, 0.6, 2.5);
    REQUIRE(curve.size() == 7);
    CHECK(curve[3] == Breakpoint{2.5, 1.0});
    CHECK(curve[4] == Breakpoint{2.7, 3.0});
    CHECK(curve[5] == Breakpoint{3.0, 6.0});
    CHECK(curve[6].time == 3.1);
    CHECK(curve[6].value == Approx(5.0));
    // Before its first point and after its last the curve holds; at a step the later value counts.
    curve.clear();
    detail::appendPass(curve, {{0.1, 2.0}, {0.3, 4.0}, {0.3, 8.0}}, 0.3, 0.0);
    CHECK(curve == Curve{{0.0, 2.0}, {0.1, 2.0}, {0.3, 8.0}});
    curve.clear();
    detail::appendPass(curve, {{0.1, 2.0}}, 0.3, 1.0);
    CHECK(curve == Curve{{1.0, 2.0}, {1.1, 2.0}, {1.3, 2.0}});
    detail::appendPass(curve, {}, 0.3, 9.0);
    CHECK(curve.size() == 3);
}

TEST_CASE("Plays of one clip vary in their own ways, not in the same way some points later", "[scene]")
{
    constexpr std::size_t draws = 2000;
    for (std::uint64_t seed : {0u, 7u})
    {
        CHECK(seedOfPlay(seed, 0) == seed);
        for (std::uint64_t play : {1u, 2u, 3u, 1000u})
        {
            Random first(seed);
            Random other(seedOfPlay(seed, play));
            std::set<std::uint64_t> numbers;
            for (std::size_t i = 0; i < draws; ++i)
                numbers.insert(first.next());
            for (std::size_t i = 0; i < draws; ++i)
                numbers.insert(other.next());
            CHECK(numbers.size() == 2 * draws);
        }
    }
}

TEST_CASE("An unrolled loop has its passes one after the other, without markers, each varied by a seed of its own",
          "[scene]")
{
    Clip clip;
    clip.duration = 0.5;
    clip.envelope = {{0.0, 0.3}, {0.5, 0.5}};
    clip.centroid = {{0.1, 100.0}};
    clip.bands = {voiceBand(100.0, 0.5), {150.0, 200.0, 250.0, 1, {{0.0, 0.1}, {0.2, 0.9}, {0.4, 0.2}}, {}}};
    clip.noise = {{100.0, 200.0, {{0.0, 0.1}, {0.2, 0.3}}}};
    clip.transients = {{0.0, 0.5, 0.1}, {0.299, 0.6, 0.2}, {0.3, 0.7, 0.3}};
    clip.markers = {{0.0, "start"}};
    const Clip plain = unrollLoop(clip, 0.3, 3, {});
    CHECK(plain.duration == Approx(0.9));
    CHECK(plain.markers.empty());
    REQUIRE(plain.transients.size() == 6);
    for (std::size_t i = 0; i < 6; ++i)
    {
        CHECK(plain.transients[i].time == Approx(0.3 * static_cast<double>(i / 2) + (i % 2 == 0 ? 0.0 : 0.299)));
        CHECK(plain.transients[i].amplitude == (i % 2 == 0 ? 0.5 : 0.6));
    }
    CHECK(plain.envelope.size() == 6);
    CHECK(plain.centroid.size() == 9);
    for (double time = 0.001; time < 0.9; time += 0.01)
    {
        const double at = std::fmod(time, 0.3);
        CHECK(valueAt(plain.envelope, time) == Approx(valueAt(clip.envelope, at)));
        CHECK(valueAt(plain.centroid, time) == 100.0);
        CHECK(valueAt(plain.bands[0].amplitude, time) == 0.5);
        CHECK(valueAt(plain.bands[0].pitch, time) == 100.0);
        CHECK(valueAt(plain.bands[1].amplitude, time) == Approx(valueAt(clip.bands[1].amplitude, at)));
        CHECK(plain.bands[1].pitch.empty());
        CHECK(valueAt(plain.noise[0].amplitude, time) == Approx(valueAt(clip.noise[0].amplitude, at)));
    }
    const VariationParams variation{0.5, VariationScope::band, 3};
    const Clip varied = unrollLoop(clip, 0.3, 3, variation);
    const Clip first = vary(clip, variation);
    const Clip third = vary(clip, {0.5, VariationScope::band, seedOfPlay(3, 2)});
    CHECK(varied.bands[0].amplitude.front().value == first.bands[0].amplitude.front().value);
    CHECK(valueAt(varied.bands[0].amplitude, 0.75) == third.bands[0].amplitude.front().value);
    checkPinned("synthesis/a loop of three varied passes", numbersOf(varied));
}
