#include "OnsetSignals.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Interleave.h"
#include "support/Measure.h"

#include <pacini/analysis/OnsetFeatures.h>

#include <array>

using namespace pacini;
using namespace pacini::test;

namespace
{

constexpr std::size_t sumLane = OnsetFrame::bandCount;

std::vector<OnsetFrame> framesOf(std::span<const float> interleaved, double fs, std::size_t channelCount = 1)
{
    OnsetFeatures features(fs, channelCount);
    features.push(interleaved);
    features.finish();
    const auto frames = features.frames();
    return {frames.begin(), frames.end()};
}

double decibels(double ratio)
{
    return 10.0 * std::log10(ratio);
}

/// Means over frames begin..end-1: bands, their sum, lowPower, power.
std::array<double, sumLane + 3> meansOf(const std::vector<OnsetFrame>& frames, std::size_t begin, std::size_t end)
{
    std::array<double, sumLane + 3> means{};
    const double weight = 1.0 / static_cast<double>(end - begin);
    for (std::size_t k = begin; k < end; ++k)
    {
        for (std::size_t b = 0; b <= sumLane; ++b)
            means[b] += weight * static_cast<double>(frames[k].bands[b]);
        means[sumLane + 1] += weight * static_cast<double>(frames[k].lowPower);
        means[sumLane + 2] += weight * static_cast<double>(frames[k].power);
    }
    return means;
}

} // namespace

TEST_CASE("The bands of a steady tone of any frequency have a steady sum", "[analysis][onsets]")
{
    for (const double fs : {8000.0, 44100.0, 96000.0})
        for (double f = 12.0; f <= 3000.0; f *= 1.06)
        {
            const auto frames = framesOf(sine(static_cast<std::size_t>(1.2 * fs), f, fs, 0.5), fs);
            const double mean = meansOf(frames, 450, 990)[sumLane];
            double lowest = mean;
            double highest = mean;
            for (std::size_t k = 450; k < 990; ++k)
            {
                lowest = std::min(lowest, static_cast<double>(frames[k].bands[sumLane]));
                highest = std::max(highest, static_cast<double>(frames[k].bands[sumLane]));
            }
            CAPTURE(fs, f);
            CHECK(decibels(highest / mean) < 1.5);
            CHECK(decibels(lowest / mean) > -1.5);
        }
}

TEST_CASE("Every band answers most to tones of its own range", "[analysis][onsets]")
{
    const double fs = 44100.0;
    const std::array<double, sumLane> tones{60.0, 165.0, 330.0, 660.0, 1320.0, 2500.0, 7000.0};
    for (std::size_t b = 0; b < sumLane; ++b)
    {
        const auto means = meansOf(framesOf(sine(22050, tones[b], fs, 0.5), fs), 200, 400);
        CAPTURE(tones[b]);
        for (std::size_t other = 0; other < sumLane; ++other)
            if (other != b)
                CHECK(means[b] > 2.0 * means[other]);
    }
}

TEST_CASE("Power is the mean square, lowPower that of the part below 1800 Hz", "[analysis][onsets]")
{
    for (const double fs : {8000.0, 44100.0, 192000.0})
        for (const double f : {50.0, 200.0, 600.0, 3500.0})
        {
            const auto means = meansOf(framesOf(sine(static_cast<std::size_t>(fs), f, fs, 0.5), fs), 180, 720);
            CAPTURE(fs, f);
            CHECK(means[sumLane + 2] == Approx(0.125).epsilon(0.08)); // the slow DC follower takes a little at 50 Hz
            if (f < 1000.0)
                CHECK(means[sumLane + 1] == Approx(0.125).epsilon(0.12));
            else
                CHECK(means[sumLane + 1] < 1e-3 * 0.125);
        }
}

TEST_CASE("The highest band hears 6.5 kHz about as loud at every rate", "[analysis][onsets]")
{
    for (const double fs : {20000.0, 22050.0, 32000.0, 39999.0, 44100.0, 64000.0, 79000.0, 96000.0, 384000.0})
    {
        const auto means = meansOf(framesOf(sine(static_cast<std::size_t>(0.5 * fs), 6500.0, fs, 0.5), fs), 150, 350);
        CAPTURE(fs);
        CHECK(decibels(means[6] / 0.125) > -1.0);
        CHECK(decibels(means[6] / 0.125) < 5.0);
    }
}

TEST_CASE("Frames tell the same at every sample rate", "[analysis][onsets]")
{
    const auto soundAt = [](double fs)
    {
        auto x = eightKicks(fs, 0.5);
        for (const double f : {90.0, 400.0, 1100.0})
        {
            const auto tone = sine(x.size(), f, fs, 0.1);
            std::transform(x.begin(), x.end(), tone.begin(), x.begin(), std::plus<float>());
        }
        return x;
    };
    const auto expected = framesOf(soundAt(48000.0), 48000.0);
    for (const double fs : {8000.0, 11025.0, 16000.0, 22050.0, 39999.0, 44100.0, 96000.0, 192000.0, 384000.0})
    {
        const auto frames = framesOf(soundAt(fs), fs);
        // The length is rounded to samples: there may be a frame more or less.
        for (std::size_t k = 90; k < std::min(frames.size(), expected.size()) - 1; ++k)
        {
            CAPTURE(fs, k);
            const double here = static_cast<double>(frames[k].bands[sumLane]);
            REQUIRE(std::abs(decibels(here / static_cast<double>(expected[k].bands[sumLane]))) < 1.0);
            const double low = static_cast<double>(frames[k].lowPower);
            REQUIRE(std::abs(decibels(low / static_cast<double>(expected[k].lowPower))) < 1.0);
        }
    }
}

TEST_CASE("Channels in antiphase do not cancel, and channels are averaged", "[analysis][onsets]")
{
    const double fs = 44100.0;
    const auto x = eightKicks(fs, 0.5);
    auto minus = x;
    for (float& v : minus)
        v = -v;
    const std::vector<float> nothing(x.size(), 0.0f);
    const auto alone = framesOf(x, fs);
    const auto opposed = framesOf(interleave({x, minus}), fs, 2);
    CHECK((opposed == framesOf(interleave({x, x}), fs, 2)));
    const auto half = framesOf(interleave({nothing, x}), fs, 2);
    REQUIRE(opposed.size() == alone.size());
    REQUIRE(half.size() == alone.size());
    for (std::size_t k = 0; k < alone.size(); ++k)
    {
        REQUIRE(opposed[k].power == alone[k].power);
        REQUIRE(opposed[k].bands[sumLane] == Approx(alone[k].bands[sumLane]).epsilon(1e-5));
        REQUIRE(half[k].power == 0.5f * alone[k].power);
    }
}

TEST_CASE("How the input is cut does not show in the frames", "[analysis][onsets]")
{
    for (const double fs : {8000.0, 44100.0, 192000.0})
    {
        const auto x = noise(2 * static_cast<std::size_t>(0.4 * fs), 5);
        const auto whole = framesOf(x, fs, 2);
        Random random(12);
        for (const std::size_t longest : {1u, 50u, 5000u, 20000u})
        {
            OnsetFeatures features(fs, 2);
            std::vector<OnsetFrame> frames;
            for (std::size_t i = 0; i < x.size();)
            {
                const std::size_t n = std::min(x.size() - i, 2 * (1 + random.next() % longest));
                features.push(std::span(x).subspan(i, n));
                i += n;
                const auto ready = features.frames();
                const std::size_t taken = random.next() % (ready.size() + 1);
                frames.insert(frames.end(), ready.begin(), ready.begin() + static_cast<std::ptrdiff_t>(taken));
                features.drop(taken);
            }
            features.finish();
            const auto rest = features.frames();
            frames.insert(frames.end(), rest.begin(), rest.end());
            CAPTURE(fs, longest);
            CHECK((frames == whole));
        }
    }
}

TEST_CASE("A constant offset does nothing", "[analysis][onsets]")
{
    const double fs = 44100.0;
    const auto still = framesOf(std::vector<float>(22050, 0.5f), fs);
    for (const OnsetFrame& frame : still)
    {
        REQUIRE(frame.power < 1e-9f);
        REQUIRE(frame.bands[sumLane] < 1e-9f);
    }
    const auto x = eightKicks(fs, 0.4);
    auto shifted = x;
    for (float& v : shifted)
        v += 0.5f;
    const auto expected = framesOf(x, fs);
    const auto frames = framesOf(shifted, fs);
    for (std::size_t k = 0; k < frames.size(); ++k)
    {
        CAPTURE(k);
        REQUIRE(frames[k].power == Approx(expected[k].power).epsilon(1e-3).margin(1e-7));
        REQUIRE(frames[k].lowPower == Approx(expected[k].lowPower).epsilon(1e-3).margin(1e-7));
        REQUIRE(frames[k].bands[sumLane] == Approx(expected[k].bands[sumLane]).epsilon(1e-3).margin(1e-7));
    }
}

TEST_CASE("Frames are as many as the sound lasts, at its end too", "[analysis][onsets]")
{
    for (const double fs : {8000.0, 44100.0, 192000.0})
        for (const std::size_t length : {0u, 1u, 2u, 8u, 9u, 48u, 49u, 50u, 98u, 441u, 4410u})
        {
            const auto frames = framesOf(std::vector<float>(length, 0.25f), fs);
            CAPTURE(fs, length);
            CHECK(frames.size() ==
                  static_cast<std::size_t>(std::ceil(static_cast<double>(length) * OnsetFrame::rate / fs)));
        }
    // A tone that is cut off loses nothing in its last frames.
    const auto frames = framesOf(sine(44100, 441.0, 44100.0, 0.5), 44100.0);
    for (std::size_t k = frames.size() - 20; k < frames.size(); ++k)
        CHECK(frames[k].bands[sumLane] == Approx(frames[k - 100].bands[sumLane]).epsilon(0.3));
}

TEST_CASE("Frames of garbage at full scale are finite and not negative", "[analysis][onsets]")
{
    for (const double fs : {2000.0, 8000.0, 44100.0, 768000.0})
    {
        Random random(4);
        std::vector<float> x(static_cast<std::size_t>(0.3 * fs));
        for (float& v : x)
            v = (random.next() & 1) != 0 ? 1.0f : -1.0f;
        std::vector<float> square(x.size());
        for (std::size_t i = 0; i < x.size(); ++i)
            square[i] = (i / 97) % 2 != 0 ? 1.0f : -1.0f;
        for (const auto& sound : {x, square})
            for (const OnsetFrame& frame : framesOf(sound, fs))
            {
                CAPTURE(fs);
                REQUIRE(std::isfinite(frame.power));
                REQUIRE(frame.power >= 0.0f);
                REQUIRE(std::isfinite(frame.lowPower));
                REQUIRE(frame.lowPower >= 0.0f);
                for (const float band : frame.bands)
                {
                    REQUIRE(std::isfinite(band));
                    REQUIRE(band >= 0.0f);
                    REQUIRE(band < 40.0f);
                }
            }
    }
}
