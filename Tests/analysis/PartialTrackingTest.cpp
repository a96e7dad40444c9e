#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/analysis/PartialBands.h>
#include <pacini/analysis/PartialTracking.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <span>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{

constexpr double fs = 4000.0;
constexpr double step = 0.020; // s between points

void add(std::vector<float>& x, const std::vector<float>& more, double seconds)
{
    const auto at = static_cast<std::size_t>(seconds * fs);
    for (std::size_t i = 0; i < more.size(); ++i)
        x[at + i] += more[i];
}

std::vector<float> glide(double seconds, double from, double to, double amplitude)
{
    std::vector<float> x(static_cast<std::size_t>(seconds * fs));
    double phase = 0.0;
    for (std::size_t n = 0; n < x.size(); ++n)
    {
        x[n] = static_cast<float>(amplitude * std::sin(phase));
        phase +=
            2.0 * std::numbers::pi * std::lerp(from, to, static_cast<double>(n) / static_cast<double>(x.size())) / fs;
    }
    return x;
}

} // namespace

TEST_CASE("A steady tone is one partial of its frequency and amplitude", "[analysis]")
{
    for (const double f : {31.0, 100.3, 333.3, 990.0})
        for (const double rate : {4000.0, 8000.0})
        {
            const auto partials = trackPartials(sine(static_cast<std::size_t>(rate), f, rate, 0.5), rate);
            CAPTURE(f, rate);
            REQUIRE(partials.size() == 1);
            // Half of the first and last windows are silent.
            for (std::size_t i = 4; i + 4 < partials[0].points.size(); ++i)
            {
                CHECK(partials[0].points[i].frequency == Approx(f).margin(0.5));
                CHECK(partials[0].points[i].amplitude == Approx(0.5).epsilon(0.02));
            }
            CHECK(partials[0].birth <= 1);
            CHECK(partials[0].death() >= 49);
        }
}

TEST_CASE("Partials are born and die with the tones that they stand for", "[analysis]")
{
    std::vector<float> x(static_cast<std::size_t>(2.0 * fs));
    add(x, sine(static_cast<std::size_t>(1.0 * fs), 110.0, fs, 0.4), 0.2);
    add(x, sine(static_cast<std::size_t>(0.8 * fs), 440.0, fs, 0.3), 0.9);
    const auto all = trackPartials(x, fs);
    // The sidelobes of ends that are cut off are short partials of their own, 40 dB down.
    std::vector<Partial> partials;
    std::copy_if(all.begin(), all.end(), std::back_inserter(partials),
                 [](const Partial& p) { return p.points[p.points.size() / 2].amplitude > 0.1; });
    REQUIRE(partials.size() == 2);
    const double frequencies[] = {110.0, 440.0};
    const double births[] = {0.2, 0.9};
    const double deaths[] = {1.2, 1.7};
    for (std::size_t i = 0; i < 2; ++i)
    {
        CAPTURE(i);
        CHECK(partials[i].points[partials[i].points.size() / 2].frequency == Approx(frequencies[i]).margin(0.5));
        // A window of 128 ms sees a tone half that early.
        CHECK(step * static_cast<double>(partials[i].birth) == Approx(births[i]).margin(0.08));
        CHECK(step * static_cast<double>(partials[i].death()) == Approx(deaths[i]).margin(0.08));
    }
}

TEST_CASE("A glide is one partial, a leap is two", "[analysis]")
{
    const auto smooth = trackPartials(glide(1.0, 100.0, 300.0, 0.5), fs);
    REQUIRE(!smooth.empty());
    const auto longest =
        std::max_element(smooth.begin(), smooth.end(),
                         [](const Partial& a, const Partial& b) { return a.points.size() < b.points.size(); });
    CHECK(longest->points.size() >= 45);
    for (std::size_t i = 5; i + 5 < longest->points.size(); ++i)
    {
        const double t = step * static_cast<double>(longest->birth + i);
        CHECK(longest->points[i].frequency == Approx(100.0 + 200.0 * t).epsilon(0.03));
    }
    auto leaping = sine(static_cast<std::size_t>(0.5 * fs), 200.0, fs, 0.5);
    const auto above = sine(static_cast<std::size_t>(0.5 * fs), 400.0, fs, 0.5);
    leaping.insert(leaping.end(), above.begin(), above.end());
    for (const Partial& partial : trackPartials(leaping, fs))
        for (std::size_t i = 1; i < partial.points.size(); ++i)
            CHECK(std::abs(partial.points[i].frequency - partial.points[i - 1].frequency) < 0.07 * 400.0);
}

TEST_CASE("A partial sleeps over missing frames, in a straight line, and no longer than it may", "[analysis]")
{
    PartialTrackingParams params;
    params.sleep = 2;
    params.shortest = 1;
    const std::vector<PartialPoint> first{{100.0, 0.5}}, second{{103.0, 0.8}}, none;
    for (const std::size_t missing : {0u, 1u, 2u, 3u})
    {
        detail::PartialTracker tracker(params);
        tracker.push(first);
        for (std::size_t i = 0; i < missing; ++i)
            tracker.push(none);
        tracker.push(second);
        const auto partials = tracker.finish();
        CAPTURE(missing);
        REQUIRE(partials.size() == (missing <= 2 ? 1 : 2));
        if (missing == 2)
        {
            REQUIRE(partials[0].points.size() == 4);
            CHECK(partials[0].points[1].frequency == Approx(101.0));
            CHECK(partials[0].points[2].amplitude == Approx(0.7));
        }
        if (missing == 3)
            CHECK(partials[1].birth == 4);
    }
}

TEST_CASE("The stronger partial chooses first, and each takes the nearest peak", "[analysis]")
{
    PartialTrackingParams params;
    params.shortest = 1;
    detail::PartialTracker tracker(params);
    tracker.push(std::vector<PartialPoint>{{100.0, 0.1}, {104.0, 0.9}});
    tracker.push(std::vector<PartialPoint>{{101.9, 0.5}, {109.0, 0.5}});
    const auto partials = tracker.finish();
    REQUIRE(partials.size() == 3);
    CHECK(partials[0].points.size() == 1); // 101.9 was the nearest of the stronger one, 109 is too far
    REQUIRE(partials[1].points.size() == 2);
    CHECK(partials[1].points[1].frequency == 101.9);
    CHECK(partials[2].birth == 1);
    CHECK(partials[2].points[0].frequency == 109.0);
}

TEST_CASE("What is short, faint or out of range is no partial", "[analysis]")
{
    const auto x = sine(4000, 200.0, fs, 0.01);
    PartialTrackingParams params;
    CHECK(trackPartials(x, fs, params).size() == 1);
    params.floor = Decibels(-39.0);
    CHECK(trackPartials(x, fs, params).empty());
    params = {};
    params.shortest = 60;
    CHECK(trackPartials(x, fs, params).empty());
    params = {};
    params.low = Hertz(220.0);
    CHECK(trackPartials(x, fs, params).empty());
    params = {};
    params.high = Hertz(190.0);
    CHECK(trackPartials(x, fs, params).empty());
    CHECK(trackPartials({}, fs).empty());
    CHECK(trackPartials(std::vector<float>(1, 1.0f), fs).size() <= 20);
    CHECK(trackPartials(std::vector<float>(4000, 0.0f), fs).empty());
}

TEST_CASE("Partials of a noise hold its power", "[analysis]")
{
    PartialTrackingParams params;
    params.low = Hertz(1.0);
    params.high = Hertz(1999.0);
    params.shortest = 1;
    const auto x = noise(16000, 12);
    double power = 0.0;
    for (const Partial& partial : trackPartials(x, fs, params))
        for (const PartialPoint& point : partial.points)
            power += 0.5 * point.amplitude * point.amplitude / 201.0;
    CHECK(power == Approx(1.0 / 3.0).epsilon(0.05));
}

TEST_CASE("Bands take partials whole: power together, the strongest one's frequency", "[analysis]")
{
    const std::vector<BandEdges> bands{{50.0, 70.0, 100.0}, {100.0, 140.0, 200.0}};
    const std::vector<Partial> partials{
        {1, {{90.0, 0.1}, {120.0, 0.4}, {140.0, 0.4}}}, // mostly above 100 Hz
        {2, {{160.0, 0.3}, {160.0, 0.3}}},
        {0, {{20.0, 0.2}}},
        {3, {{900.0, 0.5}, {900.0, 0.5}}}, // its end lies after the last frame
    };
    const auto tracks = partialTracks(partials, bands, 4);
    REQUIRE(tracks.size() == 2);
    const float amplitudes[2][4] = {{0.2f, 0.0f, 0.0f, 0.0f}, {0.0f, 0.1f, 0.5f, std::sqrt(0.16f + 0.09f + 0.25f)}};
    const float frequencies[2][4] = {{20.0f, 0.0f, 0.0f, 0.0f}, {0.0f, 90.0f, 120.0f, 900.0f}};
    for (std::size_t k = 0; k < 2; ++k)
    {
        REQUIRE(tracks[k].amplitude.size() == 4);
        REQUIRE(tracks[k].frequency.size() == 4);
        for (std::size_t m = 0; m < 4; ++m)
        {
            CAPTURE(k, m);
            CHECK(tracks[k].amplitude[m] == Approx(amplitudes[k][m]).margin(1e-6));
            CHECK(tracks[k].frequency[m] == frequencies[k][m]);
        }
    }
}
