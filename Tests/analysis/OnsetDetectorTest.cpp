#include "OnsetSignals.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/analysis/OnsetDetector.h>

#include <cmath>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{

constexpr double rates[] = {8000.0, 44100.0, 96000.0};

std::vector<Onset> onsetsOf(std::span<const float> mono, double fs, const OnsetParams& params = {})
{
    return detectOnsets(mono, 1, fs, params);
}

/// An onset at `time` of a level in dB.
Onset heard(double time, double level, double salience = 2.0)
{
    return {time, Decibels(level).gain(), 0.0, 0.5, salience};
}

std::vector<double> timesOf(const std::vector<Onset>& onsets)
{
    std::vector<double> times;
    for (const Onset& onset : onsets)
        times.push_back(onset.time);
    return times;
}

} // namespace

TEST_CASE("A steady tone is one event at most", "[analysis][onsets]")
{
    for (const double fs : rates)
        for (const double f : {20.0, 30.0, 60.0, 250.0, 1000.0})
            for (const double phase : {0.0, 0.3, 1.57})
            {
                const auto tone = sine(static_cast<std::size_t>(8.0 * fs), f, fs, 0.5, phase);
                CAPTURE(fs, f, phase);
                CHECK(onsetsOf(tone, fs).size() <= 1);
            }
}

TEST_CASE("The edges of a low saw wave are no events", "[analysis][onsets][slow]")
{
    const double fs = 44100.0;
    for (const double f : {20.0, 25.0, 33.0, 40.0, 50.0, 60.0, 80.0})
    {
        auto saw = silence(4.0, fs);
        for (std::size_t n = 0; n < saw.size(); ++n)
        {
            // Harmonics up to 8 kHz, so that no edge folds back.
            double sum = 0.0;
            for (double h = 1.0; h * f < 8000.0; h += 1.0)
                sum += std::sin(2.0 * std::numbers::pi * std::fmod(h * f * static_cast<double>(n) / fs, 1.0)) / h;
            saw[n] = static_cast<float>(0.3 * sum);
        }
        CAPTURE(f);
        CHECK(onsetsOf(saw, fs).size() <= 2);
    }
}

TEST_CASE("Noise that swells four times a second is one event at most", "[analysis][onsets]")
{
    for (const double fs : rates)
        for (const std::uint64_t seed : {1u, 2u, 3u, 4u})
        {
            CAPTURE(fs, seed);
            CHECK(onsetsOf(swellingNoise(8.0, fs, 4.0, seed), fs).size() <= 1);
        }
}

TEST_CASE("Eight equal strokes are eight equal events on time", "[analysis][onsets]")
{
    for (const double fs : {8000.0, 11025.0, 44100.0, 48000.0, 96000.0, 384000.0})
    {
        const auto onsets = onsetsOf(eightKicks(fs, 0.8), fs);
        CAPTURE(fs);
        REQUIRE(onsets.size() == 8);
        for (std::size_t i = 0; i < onsets.size(); ++i)
        {
            CHECK(onsets[i].time == Approx(0.25 + 0.5 * static_cast<double>(i)).margin(0.002));
            CHECK(onsets[i].amplitude == Approx(onsets[0].amplitude).epsilon(0.01));
            CHECK(onsets[i].lowAmplitude == Approx(onsets[0].lowAmplitude).epsilon(0.01));
            CHECK(onsets[i].sharpness == Approx(onsets[0].sharpness).margin(0.01));
            CHECK(onsets[i].salience == Approx(onsets[0].salience).epsilon(0.03));
        }
        CHECK(onsets[0].amplitude == Approx(0.8).epsilon(0.1));
        CHECK(onsets[0].sharpness < 0.2);
    }
}

TEST_CASE("A quieter copy has the same events, quieter", "[analysis][onsets]")
{
    const double fs = 44100.0;
    auto loud = eightKicks(fs, 0.5);
    for (int i = 0; i < 20; ++i)
        addClick(loud, 0.4 + 0.137 * i, fs, 0.15);
    const auto expected = onsetsOf(loud, fs);
    REQUIRE(expected.size() >= 12);
    for (const double gain : {0.1, 0.01})
    {
        auto quiet = loud;
        for (float& v : quiet)
            v *= static_cast<float>(gain);
        const auto onsets = onsetsOf(quiet, fs);
        CAPTURE(gain);
        REQUIRE(onsets.size() == expected.size());
        for (std::size_t i = 0; i < onsets.size(); ++i)
        {
            CHECK(onsets[i].time == Approx(expected[i].time).margin(1e-4));
            CHECK(onsets[i].amplitude == Approx(gain * expected[i].amplitude).epsilon(1e-3));
        }
    }
}

TEST_CASE("Every click of a train is one event, up to 60 a second", "[analysis][onsets]")
{
    for (const double fs : rates)
        for (const double rate : {10.0, 30.0, 50.0, 60.0})
        {
            auto sound = silence(2.5, fs);
            const int count = static_cast<int>(2.0 * rate);
            for (int i = 0; i < count; ++i)
                addClick(sound, 0.2 + i / rate, fs, 0.7);
            const auto onsets = onsetsOf(sound, fs);
            CAPTURE(fs, rate);
            REQUIRE(std::ssize(onsets) == count);
            for (int i = 0; i < count; ++i)
                CHECK(onsets[static_cast<std::size_t>(i)].time == Approx(0.2 + i / rate).margin(0.002));
        }
}

TEST_CASE("Onsets of tones, noise and clicks are on time wherever they lie", "[analysis][onsets]")
{
    const double fs = 44100.0;
    Random random(14);
    for (int trial = 0; trial < 30; ++trial)
    {
        const double time = random.uniform(0.3, 0.6);
        const auto start = static_cast<std::size_t>(time * fs);
        auto sound = silence(1.2, fs);
        for (float& v : sound)
            v = static_cast<float>(random.uniform(-1e-4, 1e-4));
        double sharpness = 0.0;
        if (trial % 3 == 0)
        {
            const auto tone = sine(sound.size() - start, 300.0, fs, 0.4);
            std::copy(tone.begin(), tone.end(), sound.begin() + static_cast<std::ptrdiff_t>(start));
            sharpness = 0.3;
        }
        else if (trial % 3 == 1)
        {
            for (std::size_t i = start; i < sound.size(); ++i)
                sound[i] = static_cast<float>(random.uniform(-0.4, 0.4));
            sharpness = 1.0;
        }
        else
        {
            addClick(sound, static_cast<double>(start) / fs, fs, 0.5);
            sharpness = 0.35;
        }
        const auto onsets = onsetsOf(sound, fs);
        CAPTURE(trial, time);
        REQUIRE(onsets.size() == 1);
        CHECK(onsets[0].time == Approx(time).margin(0.0015));
        CHECK(onsets[0].sharpness == Approx(sharpness).margin(0.15));
    }
}

TEST_CASE("Strokes on one channel of several are found", "[analysis][onsets]")
{
    const double fs = 44100.0;
    const auto kicks = eightKicks(fs, 0.5);
    std::vector<float> stereo;
    for (const float v : kicks)
    {
        stereo.push_back(v);
        stereo.push_back(-v);
    }
    CHECK(timesOf(detectOnsets(stereo, 2, fs)) == timesOf(onsetsOf(kicks, fs)));
    std::vector<float> four;
    for (const float v : kicks)
        four.insert(four.end(), {0.0f, 0.0f, v, 0.0f});
    CHECK(detectOnsets(four, 4, fs).size() == 8);
}

TEST_CASE("A louder stroke soon after does not count for the one before", "[analysis][onsets]")
{
    const double fs = 44100.0;
    auto sound = silence(1.0, fs);
    addClick(sound, 0.3, fs, 0.4);
    addClick(sound, 0.318, fs, 0.8);
    const auto onsets = onsetsOf(sound, fs);
    REQUIRE(onsets.size() == 2);
    CHECK(onsets[0].amplitude == Approx(0.5 * onsets[1].amplitude).epsilon(0.1));
}

TEST_CASE("More sensitivity never loses events, and finds weaker ones", "[analysis][onsets]")
{
    const double fs = 44100.0;
    auto sound = swellingNoise(4.0, fs, 2.0, 9);
    for (int i = 0; i < 10; ++i)
        addClick(sound, 0.3 + 0.35 * i, fs, 0.1 * (i + 1));
    std::size_t before = 0;
    for (const double sensitivity : {0.1, 0.5, 1.0, 2.0, 4.0, 100.0})
    {
        OnsetParams params;
        params.sensitivity = sensitivity;
        const std::size_t count = onsetsOf(sound, fs, params).size();
        CHECK(count >= before);
        before = count;
    }
    OnsetParams little;
    little.sensitivity = 0.5;
    CHECK(before > onsetsOf(sound, fs, little).size() + 5);
}

TEST_CASE("Two events are never closer than the minimum gap", "[analysis][onsets]")
{
    const double fs = 44100.0;
    auto sound = silence(2.0, fs);
    for (int i = 0; i < 25; ++i)
        addClick(sound, 0.2 + 0.04 * i, fs, 0.5);
    for (const double gap : {0.01, 0.05, 0.11})
    {
        OnsetParams params;
        params.minimumGap = Seconds(gap);
        const auto onsets = onsetsOf(sound, fs, params);
        REQUIRE(onsets.size() > 5);
        for (std::size_t i = 1; i < onsets.size(); ++i)
            CHECK(onsets[i].time - onsets[i - 1].time >= gap - 2.0 / OnsetFrame::rate);
    }
}

TEST_CASE("Next to nothing and extremes have few onsets or none", "[analysis][onsets]")
{
    for (const double fs : {2000.0, 8000.0, 44100.0, 768000.0})
    {
        const auto second = static_cast<std::size_t>(fs);
        CAPTURE(fs);
        CHECK(onsetsOf({}, fs).empty());
        CHECK(onsetsOf(std::vector<float>(1, 0.5f), fs).empty());
        CHECK(onsetsOf(std::vector<float>(second, 0.0f), fs).empty());
        CHECK(onsetsOf(std::vector<float>(second, 0.7f), fs).empty());
        CHECK(onsetsOf(std::vector<float>(second, 1e-6f), fs).empty());
        CHECK(onsetsOf(impulse(second, second / 2), fs).size() == 1);
        for (const std::size_t length : {2u, 3u, 9u, 50u, 100u, 1000u})
        {
            const auto onsets = onsetsOf(noise(length, length), fs);
            CHECK(onsets.size() <= 1);
            for (const Onset& onset : onsets)
            {
                CHECK(onset.time >= 0.0);
                CHECK(onset.time <= static_cast<double>(length) / fs);
            }
        }
        for (const Onset& onset : onsetsOf(noise(second, 3), fs))
        {
            CHECK(std::isfinite(onset.amplitude));
            CHECK(onset.amplitude > 0.0);
            CHECK(onset.salience >= 1.0);
            CHECK((onset.sharpness >= 0.0 && onset.sharpness <= 1.0));
        }
    }
    auto clipped = eightKicks(44100.0, 20.0);
    for (float& v : clipped)
        v = std::clamp(v, -1.0f, 1.0f);
    CHECK(onsetsOf(clipped, 44100.0).size() == 8);
}

TEST_CASE("The dither of 16-bit files is no event, what is a little louder is", "[analysis][onsets]")
{
    const double fs = 44100.0;
    auto sound = silence(2.0, fs);
    Random random(5);
    for (std::size_t i = sound.size() / 2; i < sound.size(); ++i)
        sound[i] = static_cast<float>((random.uniform() + random.uniform() - 1.0) / 32768.0);
    CHECK(onsetsOf(sound, fs).empty());
    for (float& v : sound)
        v *= 8.0f;
    CHECK(onsetsOf(sound, fs).size() == 1);
}

TEST_CASE("Pieces of any size give the same onsets", "[analysis][onsets]")
{
    const double fs = 44100.0;
    auto sound = eightKicks(fs, 0.5);
    for (int i = 0; i < 60; ++i)
        addClick(sound, 0.5 + 0.03 * i, fs, 0.5);
    const auto whole = onsetsOf(sound, fs);
    REQUIRE(whole.size() > 30);
    Random random(2);
    for (const std::size_t longest : {1u, 100u, 3000u, 100000u})
    {
        OnsetFeatures features(fs, 1);
        OnsetDetector detector;
        for (std::size_t i = 0; i < sound.size();)
        {
            const std::size_t n = std::min(sound.size() - i, 1 + random.next() % longest);
            features.push(std::span(sound).subspan(i, n));
            i += n;
            detector.push(features.frames());
            features.drop(features.frames().size());
        }
        features.finish();
        detector.push(features.frames());
        CAPTURE(longest);
        CHECK((detector.finish() == whole));
    }
}

TEST_CASE("Ten minutes of sound need no more memory than its first seconds", "[analysis][onsets]")
{
    const double fs = 8000.0;
    const auto block = sine(4096, 125.0, fs, 0.5); // whole periods
    OnsetFeatures features(fs, 1);
    OnsetDetector detector;
    const auto play = [&](double seconds)
    {
        for (double played = 0.0; played < seconds; played += 4096.0 / fs)
        {
            features.push(block);
            detector.push(features.frames());
            features.drop(features.frames().size());
        }
    };
    play(10.0);
    const HeapGuard guard;
    play(600.0);
    CHECK(guard.traffic() == 0);
}

TEST_CASE("Louder neighbours mask by level, distance and salience", "[analysis][onsets]")
{
    OnsetParams params;
    params.maskMargin = Decibels(8.0);
    params.maskSlope = 0.06;
    params.maskRecovery = 20.0;
    params.maskLimit = Decibels(27.0);
    const auto kept = [&params](std::vector<Onset> onsets)
    {
        return timesOf(unmaskedOnsets(onsets, params));
    };
    using Times = std::vector<double>;
    CHECK(kept({}).empty());
    CHECK(kept({heard(1.0, -20.0, 1.0)}) == Times{1.0});

    // Up to 8 dB below (and recovery over 0.1 s: 2 dB), no more salience is needed.
    CHECK(kept({heard(1.0, 0.0), heard(1.1, -9.9, 1.0)}) == Times{1.0, 1.1});
    // 4 dB more need 0.24 more.
    CHECK(kept({heard(1.0, 0.0), heard(1.1, -14.0, 1.23)}) == Times{1.0});
    CHECK(kept({heard(1.0, 0.0), heard(1.1, -14.0, 1.25)}) == Times{1.0, 1.1});
    // What comes before is masked as well.
    CHECK(kept({heard(1.0, -14.0, 1.23), heard(1.1, 0.0)}) == Times{1.1});
    CHECK(kept({heard(1.0, -14.0, 1.25), heard(1.1, 0.0)}) == Times{1.0, 1.1});
    // No salience helps beyond the limit; distance does.
    CHECK(kept({heard(1.0, 0.0), heard(1.1, -29.1, 100.0)}) == Times{1.0});
    CHECK(kept({heard(1.0, 0.0), heard(1.1, -28.9, 100.0)}) == Times{1.0, 1.1});
    CHECK(kept({heard(1.0, 0.0), heard(2.0, -46.9, 100.0)}) == Times{1.0, 2.0});
    CHECK(kept({heard(1.0, 0.0), heard(2.0, -27.9, 1.0)}) == Times{1.0, 2.0});
    // A mask reaches beyond a neighbour that is weaker itself, masked or not.
    CHECK(kept({heard(1.0, 0.0), heard(1.1, -20.0, 2.0), heard(1.2, -15.0, 1.0)}) == Times{1.0, 1.1});
    // Equals do not mask each other.
    CHECK(kept({heard(1.0, -3.0, 1.0), heard(1.01, -3.0, 1.0), heard(1.02, -3.0, 1.0)}) == Times{1.0, 1.01, 1.02});
    // Silence.
    CHECK(kept({heard(1.0, -89.0, 1.0)}) == Times{1.0});
    CHECK(kept({heard(1.0, -91.0, 9.0)}).empty());
    CHECK(kept({{1.0, 0.0, 0.0, 0.0, 9.0}}).empty());
}

TEST_CASE("The parameters of onset detection are those that were set on drums", "[analysis][onsets]")
{
    const OnsetParams usual;
    CHECK(test::asNumbers(usual.sensitivity, usual.minimumGap.value, usual.maskMargin.value, usual.maskSlope,
                          usual.maskRecovery, usual.maskLimit.value,
                          usual.silence.value) == test::Numbers{1.0, 0.010, 8.0, 0.06, 20.0, 27.0, -90.0});
    CHECK(Onset{} == Onset{0.0, 0.0, 0.0, 0.0, 0.0});
}

TEST_CASE("An onset is masked by what its neighbours leave at its time, before and after", "[analysis][onsets]")
{
    const OnsetParams params;
    const auto amplitude = [](double dB)
    {
        return std::pow(10.0, dB / 20.0);
    };
    const auto kept = [&](std::vector<Onset> onsets)
    {
        std::vector<double> times;
        for (const Onset& onset : unmaskedOnsets(onsets, params))
            times.push_back(onset.time);
        return times;
    };
    using Times = std::vector<double>;
    // 10 dB below a neighbour 0.1 s away: a deficit of 8 dB, which needs no more than 1.
    CHECK(kept({{1.0, 1.0, 0.0, 0.0, 1.0}, {1.1, amplitude(-9.99), 0.0, 0.0, 1.0}}) == Times{1.0, 1.1});
    CHECK(kept({{1.0, 1.0, 0.0, 0.0, 1.0}, {1.1, amplitude(-10.1), 0.0, 0.0, 1.0}}) == Times{1.0});
    CHECK(kept({{1.0, amplitude(-10.1), 0.0, 0.0, 1.0}, {1.1, 1.0, 0.0, 0.0, 1.0}}) == Times{1.1});
    CHECK(kept({{1.0, amplitude(-9.99), 0.0, 0.0, 1.0}, {1.1, 1.0, 0.0, 0.0, 1.0}}) == Times{1.0, 1.1});
    // 10 dB of deficit beyond the margin need 1.6.
    CHECK(kept({{1.0, 1.0, 0.0, 0.0, 1.0}, {1.1, amplitude(-20.0), 0.0, 0.0, 1.601}}) == Times{1.0, 1.1});
    CHECK(kept({{1.0, 1.0, 0.0, 0.0, 1.0}, {1.1, amplitude(-20.0), 0.0, 0.0, 1.599}}) == Times{1.0});
    // Beyond 27 dB nothing helps.
    CHECK(kept({{1.0, 1.0, 0.0, 0.0, 1.0}, {1.1, amplitude(-28.9), 0.0, 0.0, 9.0}}) == Times{1.0, 1.1});
    CHECK(kept({{1.0, 1.0, 0.0, 0.0, 1.0}, {1.1, amplitude(-29.1), 0.0, 0.0, 9.0}}) == Times{1.0});
    // Over a third one in between the mask goes on.
    CHECK(kept({{1.0, 1.0, 0.0, 0.0, 1.0},
                {1.05, amplitude(-5.0), 0.0, 0.0, 1.0},
                {1.1, amplitude(-10.1), 0.0, 0.0, 1.0}}) == Times{1.0, 1.05});
    CHECK(kept({{1.0, amplitude(-10.1), 0.0, 0.0, 1.0},
                {1.05, amplitude(-5.0), 0.0, 0.0, 1.0},
                {1.1, 1.0, 0.0, 0.0, 1.0}}) == Times{1.05, 1.1});
    CHECK(kept({{1.0, amplitude(-89.9), 0.0, 0.0, 1.0}}) == Times{1.0});
    CHECK(kept({{1.0, amplitude(-90.1), 0.0, 0.0, 1.0}}).empty());
    CHECK(kept({{1.0, 1.0, 0.0, 0.0, 1.0}}) == Times{1.0});
    CHECK(kept({{1.0, 1.0, 0.0, 0.0, 0.999}}).empty());
    CHECK(kept({}).empty());
    OnsetParams deaf;
    deaf.silence = Decibels(-300.0);
    CHECK(unmaskedOnsets(std::vector<Onset>{{0.0, 0.0, 0.0, 0.0, 1.0}}, deaf).size() == 1);
    deaf.silence = Decibels(-199.0);
    CHECK(unmaskedOnsets(std::vector<Onset>{{0.0, 0.0, 0.0, 0.0, 1.0}}, deaf).empty());
}

TEST_CASE("Onsets of a mixed sound at any rate are what they were", "[analysis][onsets]")
{
    for (const double fs : {8000.0, 44100.0, 96000.0})
    {
        auto sound = swellingNoise(2.0, fs, 4.0, 5);
        for (float& v : sound)
            v *= 0.05f;
        for (const double at : {0.2, 0.31, 0.37, 0.6, 0.612, 0.9, 1.3, 1.8})
        {
            addKick(sound, at, fs, 0.4 - 0.15 * std::fmod(10.0 * at, 2.0));
            addClick(sound, at + 0.07, fs, 0.3);
        }
        for (const double sensitivity : {0.1, 0.5, 1.0, 3.0})
        {
            OnsetParams params;
            params.sensitivity = sensitivity;
            std::vector<double> times, rest;
            for (const Onset& onset : detectOnsets(sound, 1, fs, params))
            {
                times.push_back(onset.time);
                rest.insert(rest.end(), {onset.amplitude, onset.lowAmplitude, onset.sharpness, onset.salience});
            }
            const std::string name = "analysis/onsets at " + std::to_string(static_cast<int>(fs)) + ", sensitivity " +
                                     std::to_string(sensitivity);
            checkPinned(name + ", times", times, 1e-5);
            checkPinned(name + ", the rest", rest, 1e-4);
        }
        OnsetParams quarter;
        quarter.sensitivity = 0.25;
        OnsetParams less = quarter;
        less.sensitivity = 0.1;
        CHECK(detectOnsets(sound, 1, fs, less) == detectOnsets(sound, 1, fs, quarter));
        quarter.sensitivity = 4.0;
        less.sensitivity = 40.0;
        CHECK(detectOnsets(sound, 1, fs, less) == detectOnsets(sound, 1, fs, quarter));
    }
}
