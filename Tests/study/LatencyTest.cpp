#include "study/Latency.h"

#include "study/LatencyFile.h"
#include "study/TrialSound.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

#include <pacini/foundation/Gaussian.h>

#include <cmath>
#include <numbers>
#include <vector>

using namespace pacini;
using namespace pacini::study;
using Catch::Matchers::WithinAbs;
using test::TempFolder;

namespace
{
/// What comes back of the probe after `delay` seconds by a clock that runs `skew` too fast: exact values of the burst
/// at any time, so that parts of a sample are as they are.
class Returned
{
public:
    explicit Returned(const LatencyProbe& ofProbe) : probe(ofProbe) {}

    [[nodiscard]] float at(std::size_t frame, double delay, double skew = 0.0) const
    {
        const double time = static_cast<double>(frame) / probe.sampleRate * (1.0 + skew) - delay;
        const double length = 5.0 / probe.frequency;
        const double inBurst = time - std::floor(time) - 0.5 * (1.0 - length);
        if (inBurst < 0.0 || inBurst > length)
            return 0.0f;
        return static_cast<float>(0.25 * (0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * inBurst / length)) *
                                  std::sin(2.0 * std::numbers::pi * probe.frequency * inBurst));
    }

private:
    LatencyProbe probe;
};

Latency measured(const LatencyProbe& probe, double delay, double noise = 0.0, double skew = 0.0, double gain = 1.0)
{
    const Returned back(probe);
    LatencyMeter meter(probe);
    Random random(7);
    std::vector<float> sound(480), touch(480);
    const auto frames = static_cast<std::size_t>(probe.duration * probe.sampleRate);
    for (std::size_t begin = 0; begin < frames; begin += sound.size())
    {
        for (std::size_t n = 0; n < sound.size(); ++n)
        {
            sound[n] = back.at(begin + n, 0.0137) + static_cast<float>(noise * normalNumber(random));
            touch[n] = static_cast<float>(gain) * back.at(begin + n, 0.0137 + delay, skew) +
                       static_cast<float>(noise * normalNumber(random));
        }
        meter.push(sound, touch);
    }
    const auto latency = meter.latency();
    REQUIRE(latency);
    return *latency;
}
} // namespace

TEST_CASE("A delay between sound and touch is measured to a part of a sample", "[study][latency]")
{
    LatencyProbe probe;
    for (const int rate : {8000, 44100, 48000, 192000})
        for (const double frequency : {60.0, 160.0, 400.0})
            for (const double delay : {0.0, 0.001234, -0.0871, 0.31, -0.45})
            {
                CAPTURE(rate, frequency, delay);
                probe.sampleRate = rate;
                probe.frequency = frequency;
                probe.duration = 6.0;
                const auto latency = measured(probe, delay);
                CHECK_THAT(latency.delay, WithinAbs(delay, 5e-6));
                CHECK(latency.deviation < 5e-6);
                CHECK(latency.bursts >= 5);
                CHECK_THAT(latency.soundLevel, WithinAbs(20.0 * std::log10(0.25), 0.1));
            }
}

TEST_CASE("Noise and a weak sensor cost little of a measured delay", "[study][latency]")
{
    LatencyProbe probe;
    probe.duration = 20.0;
    // Noise of -50 dB re full scale: 38 dB below the loud bursts, 12 dB below the weak ones.
    const auto latency = measured(probe, 0.0042, 0.00316, 0.0, 0.05);
    CHECK_THAT(latency.delay, WithinAbs(0.0042, 5e-4));
    CHECK(latency.deviation < 1e-3);
    CHECK(latency.bursts >= 19);
    CHECK(latency.missed <= 1);
}

TEST_CASE("Clocks that run apart are told as drift", "[study][latency]")
{
    LatencyProbe probe;
    probe.sampleRate = 8000;
    probe.duration = 600.0;
    // 5 ppm, as sound devices differ: 18 ms in an hour. The touch's clock is fast, so it comes earlier and earlier.
    const auto latency = measured(probe, 0.010, 1e-4, 5e-6);
    CHECK_THAT(latency.drift, WithinAbs(-0.018, 2e-4));
    CHECK(latency.bursts >= 598);
    CHECK_THAT(measured(probe, 0.010, 1e-4).drift, WithinAbs(0.0, 2e-4));
}

TEST_CASE("What is no measurement is told as such", "[study][latency]")
{
    const LatencyProbe probe;
    const Returned back(probe);
    std::vector<float> bursts(5 * 48000), silence(bursts.size(), 0.0f), noise(bursts.size());
    Random random(3);
    for (std::size_t n = 0; n < bursts.size(); ++n)
    {
        bursts[n] = back.at(n, 0.0);
        noise[n] = static_cast<float>(0.1 * normalNumber(random));
    }
    const auto error = [&](const std::vector<float>& sound, const std::vector<float>& touch)
    {
        LatencyMeter meter(probe);
        meter.push(sound, touch);
        const auto latency = meter.latency();
        REQUIRE_FALSE(latency);
        return latency.error();
    };
    CHECK(error(silence, silence).where == "sound");
    CHECK(error(bursts, silence).where == "touch");
    CHECK(error(silence, bursts).where == "sound");
    CHECK(error(bursts, noise).where == "touch");
    CHECK(error({}, {}).where == "sound");
    LatencyProbe bad;
    for (double LatencyProbe::*field : {&LatencyProbe::duration, &LatencyProbe::frequency, &LatencyProbe::level})
    {
        bad = {};
        bad.*field = std::nan("");
        CHECK_FALSE(validate(bad));
    }
}

TEST_CASE("Measured delays are kept beside the study, the newest last", "[study][latency]")
{
    const TempFolder folder;
    REQUIRE(readLatencies(folder.path()));
    CHECK(readLatencies(folder.path())->empty());
    MeasuredLatency one{
        "2026-11-27T10:00:00.000Z", "interface", "", 44100.0, {0.0021, 1e-5, 2e-5, 0.0, 10, 1, -12.0, -20.0}};
    REQUIRE(keepLatency(folder.path(), one));
    one.latency.delay = -0.3;
    REQUIRE(keepLatency(folder.path(), one));
    const auto all = readLatencies(folder.path());
    REQUIRE(all);
    REQUIRE(all->size() == 2);
    CHECK(all->front().latency.delay == 0.0021);
    CHECK(all->back().latency.delay == -0.3);
    CHECK(all->back().latency.bursts == 10);
    CHECK(all->back().device == "interface");
    // What cannot be read is not replaced either.
    test::put(folder / "latency.json",
              "{\"format\": \"pacini.latency\", \"version\": 1, \"measurements\": [{\"time\": 3}]}");
    CHECK_FALSE(readLatencies(folder.path()));
    CHECK_FALSE(keepLatency(folder.path(), one));
}

TEST_CASE("A trial makes up for a delay that is known", "[study][latency]")
{
    Study study;
    study.groups = {{"all", 1}};
    Stimulus both;
    both.name = "both";
    both.tone = Tone{};
    study.stimuli = {both};
    Block block;
    study.blocks = {block};
    const auto onset = [&](double latency, double delay)
    {
        StimulusParams params;
        params.touchLatency = latency;
        study.blocks[0].delay = delay;
        StimulusMaker maker(study, params);
        const auto trial = makePart(maker, study.blocks[0], 0, 1);
        REQUIRE(trial);
        REQUIRE(trial->touchOnset);
        return static_cast<double>(*trial->touchOnset);
    };
    const double first = onset(0.0, 0.0);
    CHECK(onset(-0.01, 0.0) == first + 480.0);
    CHECK(onset(0.01, 0.03) == first + 960.0);
    CHECK(onset(0.01, 0.01) == first);
}
