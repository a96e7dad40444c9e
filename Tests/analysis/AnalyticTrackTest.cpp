#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/analysis/AnalyticTrack.h>
#include <pacini/foundation/Random.h>

#include <cmath>
#include <span>
#include <string>
#include <tuple>
#include <vector>

using namespace pacini;

namespace
{

using TrackSamples = std::vector<std::complex<float>>;

template <FrameContent content>
std::vector<AnalyticFrame> drained(AnalyticTrack& track, std::int64_t complete, std::int64_t frames)
{
    std::vector<AnalyticFrame> found;
    track.drain<content>(complete, frames, [&found](const AnalyticFrame& frame) { found.push_back(frame); });
    return found;
}

void add(AnalyticTrack& track, std::int64_t position, const TrackSamples& block)
{
    std::vector<float> re, im;
    for (const auto& z : block)
    {
        re.push_back(z.real());
        im.push_back(z.imag());
    }
    track.add(position, re, im);
}

constexpr std::int64_t everything = std::int64_t(1) << 40;

} // namespace

TEST_CASE("The frames of a phasor have its magnitude, power and frequency", "[analysis]")
{
    const int rate = 500;
    for (const double f : {-200.0, -1.0, 0.0, 30.0, 199.0})
    {
        TrackSamples z(1000);
        for (std::size_t n = 0; n < z.size(); ++n)
            z[n] = std::complex<float>(std::polar(0.3, 2.0 * std::numbers::pi * f * static_cast<double>(n) / rate));
        AnalyticTrack magnitudes(rate, 0.04, 0.005);
        add(magnitudes, 0, z);
        const auto a = drained<FrameContent::magnitude>(magnitudes, everything, 300);
        AnalyticTrack powers(rate, 0.04, 0.005);
        add(powers, 0, z);
        const auto b = drained<FrameContent::powerAndRotation>(powers, everything, 300);
        REQUIRE(a.size() == 300);
        REQUIRE(b.size() == 300);
        CAPTURE(f);
        for (std::size_t i = 10; i < 290; ++i)
        {
            REQUIRE(a[i].magnitude == Approx(0.3).epsilon(1e-5));
            REQUIRE(a[i].peakPower == Approx(0.09).epsilon(1e-5));
            REQUIRE(b[i].power == Approx(0.09).epsilon(1e-5));
            REQUIRE(std::abs(b[i].rotation) == Approx(0.09).epsilon(1e-5));
            REQUIRE(std::arg(b[i].rotation) * rate / (2.0 * std::numbers::pi) == Approx(f).margin(0.01));
        }
    }
}

TEST_CASE("Frames stand where they should, on samples and between them", "[analysis]")
{
    // A magnitude that grows evenly has its own value as the mean of every symmetric window.
    const int rate = 250;
    TrackSamples ramp(500);
    for (std::size_t n = 0; n < ramp.size(); ++n)
        ramp[n] = static_cast<float>(n);
    for (const double step : {0.004, 0.006, 0.020, 0.030})
    {
        AnalyticTrack track(rate, 0.040, step);
        add(track, 0, ramp);
        const auto frames = drained<FrameContent::magnitude>(track, everything, 60);
        REQUIRE(frames.size() == 60);
        for (std::size_t i = 0; i < frames.size(); ++i)
        {
            const double position = static_cast<double>(i) * step * rate;
            CAPTURE(step, i);
            if (position >= 6.0 && position <= 490.0)
                REQUIRE(frames[i].magnitude == Approx(position).epsilon(1e-5));
        }
    }
}

TEST_CASE("Blocks add up to what all of it at once gives", "[analysis]")
{
    Random random(7);
    TrackSamples whole(2000);
    for (auto& z : whole)
        z = std::complex<float>(std::complex(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)));
    whole.back() = 0.0f; // the rotation from the last sample on is unknown, so it does not count
    AnalyticTrack once(1000, 0.02, 0.005);
    add(once, -100, whole);
    const auto expected = drained<FrameContent::powerAndRotation>(once, everything, 380);

    // Blocks of 400 every 200 that fade into each other.
    AnalyticTrack track(1000, 0.02, 0.005);
    std::vector<AnalyticFrame> frames;
    for (std::size_t begin = 0; begin < whole.size(); begin += 200)
    {
        TrackSamples block(400);
        for (std::size_t i = 0; i < block.size() && begin + i < whole.size(); ++i)
        {
            const double rise = (static_cast<double>(i % 200) + 0.5) / 200.0;
            const double weight = i >= 200 ? 1.0 - rise : begin == 0 ? 1.0 : rise;
            block[i] = static_cast<float>(weight) * whole[begin + i];
        }
        add(track, static_cast<std::int64_t>(begin) - 100, block);
        const auto more =
            drained<FrameContent::powerAndRotation>(track, static_cast<std::int64_t>(begin) + 200 - 100, 380);
        frames.insert(frames.end(), more.begin(), more.end());
    }
    CHECK(frames.size() > 360); // the rest waits for blocks that might still come
    const auto rest = drained<FrameContent::powerAndRotation>(track, everything, 380);
    frames.insert(frames.end(), rest.begin(), rest.end());
    REQUIRE(frames.size() == expected.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
        REQUIRE(frames[i].power == Approx(expected[i].power).epsilon(1e-5).margin(1e-9));
        REQUIRE(std::abs(frames[i].rotation - expected[i].rotation) < 1e-5);
    }

    track.reset();
    add(track, -100, whole);
    const auto again = drained<FrameContent::powerAndRotation>(track, everything, 380);
    REQUIRE(again.size() == expected.size());
    for (std::size_t i = 0; i < again.size(); ++i)
        REQUIRE(again[i].power == expected[i].power);
}

TEST_CASE("TrackSamples outside the blocks count as silence", "[analysis]")
{
    AnalyticTrack track(1000, 0.02, 0.005);
    add(track, 0, TrackSamples(100, 1.0f));
    const auto frames = drained<FrameContent::magnitude>(track, everything, 40);
    REQUIRE(frames.size() == 40);
    CHECK(frames[0].magnitude == Approx(0.5).margin(0.06)); // half of the window is before the start
    CHECK(frames[10].magnitude == Approx(1.0).epsilon(1e-5));
    CHECK(frames[30].magnitude == 0.0);
    CHECK(frames[39].peakPower == 0.0);
}

TEST_CASE("Frames of noise are what they were at every rate, window and step", "[analysis]")
{
    for (const auto& [rate, window, step] : {std::tuple{250, 0.04, 0.02},
                                             {500, 0.04, 0.005},
                                             {2000, 0.01, 0.005},
                                             {1000, 0.0123, 0.0005},
                                             {300, 0.05, 0.005}})
    {
        Random random(4);
        TrackSamples z(400);
        for (auto& v : z)
            v = {static_cast<float>(random.uniform(-1.0, 1.0)), static_cast<float>(random.uniform(-1.0, 1.0))};
        AnalyticTrack magnitudes(rate, window, step);
        AnalyticTrack powers(rate, window, step);
        CHECK(powers.rate() == rate);
        add(magnitudes, -20, z);
        add(powers, -20, z);
        std::vector<double> all, ends;
        const auto frames = static_cast<std::int64_t>(390.0 / rate / step);
        for (const auto& frame : drained<FrameContent::magnitude>(magnitudes, everything, frames))
            all.insert(all.end(), {frame.magnitude, frame.peakPower});
        for (const auto& frame : drained<FrameContent::powerAndRotation>(powers, everything, frames))
        {
            all.insert(all.end(), {frame.power, frame.rotation.real(), frame.rotation.imag()});
            CHECK(frame.magnitude == 0.0);
        }
        const std::string name = "analysis/analytic frames at " + std::to_string(rate);
        checkPinned(name, all, 1e-5);
        checkPinned(name + ", first", std::span<const double>(all).first(12), 1e-5);
        checkPinned(name + ", last", std::span<const double>(all).last(12), 1e-5);
    }
}

TEST_CASE("A frame is there as soon as its window and the sample after it are complete", "[analysis]")
{
    // At 500 Hz a window of 40 ms reaches 10 samples to either side; with the half sample and the next one, 13.
    const TrackSamples z(100, {1.0f, 0.0f});
    AnalyticTrack track(500, 0.04, 0.02);
    add(track, 0, z);
    CHECK(drained<FrameContent::magnitude>(track, 12, 10).empty());
    CHECK(drained<FrameContent::magnitude>(track, 13, 10).size() == 1);
    CHECK(drained<FrameContent::magnitude>(track, 22, 10).empty());
    CHECK(drained<FrameContent::magnitude>(track, 33, 10).size() == 2);
    CHECK(drained<FrameContent::magnitude>(track, 100, 5).size() == 2);
    track.reset();
    add(track, 0, z);
    CHECK(drained<FrameContent::magnitude>(track, 33, 10).size() == 3);
}

TEST_CASE("A block that begins where little is left of the one before makes the track longer", "[analysis]")
{
    const TrackSamples z(100, {1.0f, 0.0f});
    AnalyticTrack track(500, 0.04, 0.02);
    add(track, 0, z);
    add(track, 90, TrackSamples(20, {0.0f, 1.0f}));
    add(track, 30, TrackSamples(5, {1.0f, 0.0f}));
    const auto found = drained<FrameContent::magnitude>(track, everything, 12);
    CHECK(found[5].magnitude == Approx(1.0).epsilon(1e-6));
    CHECK(found[9].peakPower == Approx(2.0).epsilon(1e-6));
    CHECK(found[10].peakPower == Approx(2.0).epsilon(1e-6));
    CHECK(found[11].peakPower == Approx(1.0).margin(1e-6));
}
