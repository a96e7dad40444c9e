#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/analysis/OnsetMeasure.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{

constexpr std::ptrdiff_t before = 26; ///< frames of memory that measuring may read
constexpr std::ptrdiff_t after = 25;

/// What is measured at frame `index` of the powers powerAt(k); lowPower is half of it, all of it lies in one band.
Onset measured(std::ptrdiff_t index, std::ptrdiff_t nextEvent, const std::function<double(std::ptrdiff_t)>& powerAt,
               std::size_t band = 3)
{
    std::vector<OnsetFrame> frames;
    for (std::ptrdiff_t k = index - before; k < index + after; ++k)
    {
        OnsetFrame frame;
        frame.power = static_cast<float>(powerAt(k));
        frame.lowPower = 0.5f * frame.power;
        frame.bands[band] = frame.bands[OnsetFrame::bandCount] = frame.power;
        frames.push_back(frame);
    }
    return measureOnset(frames.data() + before, index, nextEvent);
}

double seconds(double frames)
{
    return frames / OnsetFrame::rate;
}

} // namespace

TEST_CASE("The start of a sudden onset is exact to a fraction of a frame", "[analysis][onsets]")
{
    for (const double start : {50.0, 50.25, 50.5, 50.9})
        for (const double background : {0.0, 1e-5})
        {
            // A frame that the event fills in part has that part of its power.
            const auto powerAt = [&](std::ptrdiff_t k)
            {
                return background + 0.02 * std::clamp(static_cast<double>(k + 1) - start, 0.0, 1.0);
            };
            for (std::ptrdiff_t index = 47; index <= 55; ++index)
            {
                CAPTURE(start, background, index);
                CHECK(measured(index, 1000, powerAt).time == Approx(seconds(start)).margin(seconds(0.01)));
            }
        }
}

TEST_CASE("A loud background does not draw the start forward", "[analysis][onsets]")
{
    // 15 dB below the event.
    const auto powerAt = [](std::ptrdiff_t k)
    {
        return k < 50 ? 6e-4 : 0.02;
    };
    for (std::ptrdiff_t index = 47; index <= 55; ++index)
        CHECK(measured(index, 1000, powerAt).time == Approx(seconds(50.0)).margin(seconds(0.1)));
}

TEST_CASE("The start of a gradual attack lies where it leaves the background", "[analysis][onsets]")
{
    // A linear rise of amplitude over 10 frames.
    for (const double background : {0.0, 1e-4})
    {
        const auto powerAt = [background](std::ptrdiff_t k)
        {
            return background + 0.02 * std::pow(std::clamp(static_cast<double>(k - 50) / 10.0, 0.0, 1.0), 2.0);
        };
        const double time = measured(55, 1000, powerAt).time;
        CHECK(time >= seconds(50.0));
        CHECK(time <= seconds(53.0));
    }
}

TEST_CASE("A start is never before that of the sound", "[analysis][onsets]")
{
    for (std::ptrdiff_t index = 0; index < 6; ++index)
        CHECK(measured(index, 1000, [](std::ptrdiff_t k) { return k < 0 ? 0.0 : 0.02; }).time == 0.0);
}

TEST_CASE("Amplitudes are those of a sinusoid of the greatest power before the next event", "[analysis][onsets]")
{
    const auto two = [](std::ptrdiff_t k)
    {
        return k < 50 ? 0.0 : k < 65 ? 0.02 : 0.5;
    };
    const Onset onset = measured(50, 65, two);
    CHECK(onset.amplitude == Approx(0.2).epsilon(1e-6));
    CHECK(onset.lowAmplitude == Approx(0.2 * std::sqrt(0.5)).epsilon(1e-6));
    CHECK(measured(50, 1000, two).amplitude == Approx(1.0).epsilon(1e-6));
    // What comes 24 ms later belongs to it no more.
    const auto late = [](std::ptrdiff_t k)
    {
        return k < 50 ? 0.0 : k < 73 ? 0.02 : 0.5;
    };
    CHECK(measured(50, 1000, late).amplitude == Approx(0.2).epsilon(1e-6));
    // A peak of one frame is one fifth of a mean over five.
    const auto peak = [](std::ptrdiff_t k)
    {
        return k == 50 ? 0.1 : 0.0;
    };
    CHECK(measured(50, 1000, peak).amplitude == Approx(0.2).epsilon(1e-6));
}

TEST_CASE("Sharpness is the place of what is new between 150 and 2500 Hz", "[analysis][onsets]")
{
    const auto step = [](std::ptrdiff_t k)
    {
        return k < 50 ? 0.0 : 0.02;
    };
    double last = -1.0;
    for (std::size_t band = 1; band < OnsetFrame::bandCount; ++band)
    {
        const double here = measured(50, 1000, step, band).sharpness;
        const double place = std::log(OnsetFrame::bandCentres[band] / 150.0) / std::log(2500.0 / 150.0);
        CHECK(here == Approx(std::clamp(place, 0.0, 1.0)).margin(1e-6));
        CHECK(here >= last);
        last = here;
    }
    CHECK(measured(50, 1000, step, 0).sharpness == 0.0);
    CHECK(last == 1.0);

    // A steady sound in another band does not count.
    std::vector<OnsetFrame> frames(static_cast<std::size_t>(before + after));
    for (std::size_t k = 0; k < frames.size(); ++k)
    {
        frames[k].bands[0] = 0.5f;
        frames[k].bands[3] = k < static_cast<std::size_t>(before) ? 0.0f : 0.02f;
        frames[k].power = frames[k].bands[3] + 0.0001f;
    }
    const double place = std::log(OnsetFrame::bandCentres[3] / 150.0) / std::log(2500.0 / 150.0);
    CHECK(measureOnset(frames.data() + before, 50, 1000).sharpness == Approx(place).margin(1e-6));
}

TEST_CASE("Times, levels and sharpness of onsets of many shapes are what they were", "[analysis][onsets]")
{
    Random random(31);
    for (int shape = 0; shape < 12; ++shape)
    {
        std::vector<OnsetFrame> frames(90);
        const double rise = 0.2 + 0.9 * (shape % 4);
        const double background = shape % 3 == 0 ? 0.0 : 0.02 * (shape % 3);
        for (std::size_t i = 0; i < frames.size(); ++i)
        {
            const double t = static_cast<double>(i) - 40.0;
            const double level = t < 0.0 ? std::exp(t / rise) : std::exp(-t / 9.0) * (1.0 + 0.3 * std::sin(t));
            frames[i].power = static_cast<float>(background * random.uniform(0.5, 1.5) + level);
            frames[i].lowPower = 0.4f * frames[i].power;
            for (std::size_t b = 0; b < 8; ++b)
                frames[i].bands[b] = static_cast<float>(random.uniform(0.0, 0.02) +
                                                        level * (static_cast<int>(b) == shape % 7 ? 0.5 : 0.1));
        }
        std::vector<double> all;
        for (const std::ptrdiff_t index : {41, 43, 2, 0})
            for (const std::ptrdiff_t next : {1000, 8, 3})
            {
                const Onset onset = measureOnset(frames.data() + 41, index, index + next);
                all.insert(all.end(), {onset.time, onset.amplitude, onset.lowAmplitude, onset.sharpness});
                CHECK(onset.salience == 0.0);
            }
        checkPinned("analysis/onset of shape " + std::to_string(shape), all, 1e-6);
        checkPinned("analysis/onset of shape " + std::to_string(shape) + ", first",
                    std::span<const double>(all).first(8), 1e-6);
    }
}

TEST_CASE("An attack is looked for from 12 frames before to 8 after the peak", "[analysis][onsets]")
{
    const auto startOf = [](const std::vector<std::pair<std::ptrdiff_t, float>>& powers, std::ptrdiff_t index = 1000)
    {
        std::vector<OnsetFrame> frames(60);
        for (const auto& [at, power] : powers)
            frames[static_cast<std::size_t>(30 + at)].power = power;
        return detail::attackStart(frames.data() + 30, index);
    };
    CHECK(startOf({{0, 1.0f}}) == 0);
    CHECK(startOf({{-3, 1.0f}}) == -3);
    CHECK(startOf({{-4, 1.0f}}) == -4); // a frame of silence reaches half of nothing, and back it goes
    CHECK(startOf({{8, 1.0f}}) == 8);
    CHECK(startOf({{9, 1.0f}}) == -3); // beyond the frames that are looked at
    // A quarter of the peak is half of its amplitude.
    CHECK(startOf({{0, 0.25f}, {2, 1.0f}}) == 0);
    CHECK(startOf({{0, 0.24f}, {1, 0.0f}, {2, 1.0f}}) == 2);
    // Back as long as 8 % of the amplitude is exceeded, and at most 9 frames.
    CHECK(startOf({{-1, 0.0065f}, {0, 1.0f}}) == -1);
    CHECK(startOf({{-1, 0.0063f}, {0, 1.0f}}) == 0);
    CHECK(startOf({{-2, 0.0065f}, {-1, 0.02f}, {0, 1.0f}}) == -2);
    std::vector<std::pair<std::ptrdiff_t, float>> ramp;
    for (std::ptrdiff_t i = -20; i < 0; ++i)
        ramp.emplace_back(i, 0.2f);
    ramp.emplace_back(0, 1.0f);
    CHECK(startOf(ramp) == 0); // it stands out from no background
    // A quarter of the peak 4 frames before stands out from any background, back to 9 frames before the first that is
    // looked at, and never before the start of the sound.
    for (auto& [at, power] : ramp)
        power = at < 0 ? 0.3f : power;
    CHECK(startOf(ramp) == -12);
    CHECK(startOf(ramp, 5) == -5);
    for (auto& [at, power] : ramp)
        power = at < -8 ? 0.0f : at < 0 ? 0.2f : power;
    CHECK(startOf(ramp) == -8);
    CHECK(startOf(ramp, 4) == -4);
    CHECK(startOf(ramp, 0) == 0);
    // 2.5 times the median of the background: 6.25 of power.
    for (const float before : {0.031f, 0.033f})
    {
        std::vector<std::pair<std::ptrdiff_t, float>> steady;
        for (std::ptrdiff_t i = -20; i < -1; ++i)
            steady.emplace_back(i, before);
        steady.emplace_back(-1, 0.2f);
        steady.emplace_back(0, 1.0f);
        CHECK(startOf(steady) == (before < 0.032f ? -1 : 0));
    }
}

TEST_CASE("The greatest power of five frames is found wherever it is", "[analysis][onsets]")
{
    std::vector<OnsetFrame> frames(20);
    for (std::size_t i = 5; i < 10; ++i)
        frames[i].power = 2.0f;
    const auto greatest = [&](std::ptrdiff_t count)
    {
        return detail::greatestPower(frames.data(), count, [](const OnsetFrame& f) { return f.power; });
    };
    CHECK(greatest(5) == 0.0);
    CHECK(greatest(6) == Approx(0.4));
    CHECK(greatest(9) == Approx(1.6));
    CHECK(greatest(10) == Approx(2.0));
    CHECK(greatest(20) == Approx(2.0));
}

TEST_CASE("Sharpness is that of the band that gains, between 150 and 2500 Hz", "[analysis][onsets]")
{
    for (std::size_t b = 0; b < OnsetFrame::bandCount; ++b)
    {
        std::vector<OnsetFrame> frames(16);
        for (std::size_t i = 8; i < 16; ++i)
            frames[i].bands[b] = 1.0f;
        const double position = std::log(OnsetFrame::bandCentres[b] / 150.0) / std::log(2500.0 / 150.0);
        CHECK(detail::sharpness(frames.data() + 8) == Approx(std::clamp(position, 0.0, 1.0)));
        // What falls does not count, nor what was there 9 frames before or comes 8 after.
        std::vector<OnsetFrame> falls(18);
        falls[1].bands[b] = 1.0f;
        CHECK(detail::sharpness(falls.data() + 9) == 0.0);
        std::vector<OnsetFrame> outside(20);
        outside[1].bands[b] = 1.0f;
        outside[18].bands[b] = 1.0f;
        CHECK(detail::sharpness(outside.data() + 10) == 0.0);
        std::vector<OnsetFrame> last(20);
        last[17].bands[b] = 1.0f;
        CHECK(detail::sharpness(last.data() + 10) == Approx(std::clamp(position, 0.0, 1.0)));
    }
    CHECK(OnsetFrame::bandCentres == std::array<double, 7>{56.0, 159.0, 318.0, 636.0, 1273.0, 2546.0, 6600.0});
}
