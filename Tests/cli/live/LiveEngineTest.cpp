#include "cli/live/LiveEngine.h"

#include "live/LiveDrive.h"
#include "live/TrackedDrive.h"
#include "support/Catch.h"
#include "support/HeapGuard.h"

#include <pacini/realtime/Translator.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

using namespace pacini;
using namespace pacini::cli;
using namespace pacini::live;

namespace
{
std::vector<float> tone(double frequency, double fs, std::size_t frames)
{
    std::vector<float> samples(frames);
    for (std::size_t i = 0; i < frames; ++i)
        samples[i] =
            static_cast<float>(0.5 * std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(i) / fs));
    return samples;
}
} // namespace

TEST_CASE("Live: the drive is the translator's, to the sample, whatever the blocks")
{
    const auto sound = tone(60.0, 48000.0, 48000);
    TranslatorParams params;
    params.intensity = -3.0;
    Translator translator;
    translator.prepare({48000.0, 512});
    translator.setParams(params);
    translator.reset();
    std::vector<float> expected(sound.size());
    translator.process(sound, expected);

    for (const std::size_t block : {1u, 37u, 128u, 4800u})
    {
        LiveDrive drive(sound.size());
        LiveEngine engine(48000.0, {}, params);
        engine.add(drive);
        for (std::size_t i = 0; i < sound.size(); i += block)
            engine.process(std::span(sound).subspan(i, std::min(block, sound.size() - i)), 1);
        engine.end();
        std::vector<float> got(sound.size());
        REQUIRE(drive.take(got) == sound.size());
        CHECK(drive.isOver());
        CHECK(got == expected);
    }
}

TEST_CASE("Live: two equal channels are one of them")
{
    const auto mono = tone(60.0, 48000.0, 4800);
    std::vector<float> both;
    for (const float sample : mono)
        both.insert(both.end(), {sample, sample});
    std::vector<float> one(mono.size()), two(mono.size());
    for (const std::size_t channels : {std::size_t(1), std::size_t(2)})
    {
        LiveDrive drive(mono.size());
        LiveEngine engine(48000.0, {}, {});
        engine.add(drive);
        engine.process(channels == 1 ? mono : both, channels);
        REQUIRE(drive.take(channels == 1 ? one : two) == mono.size());
    }
    CHECK(one == two);
}

TEST_CASE("Live: translating and handing out makes no heap traffic, also when an output is full")
{
    const auto sound = tone(60.0, 48000.0, 9600);
    LiveDrive drive(9600), narrow(64);
    LatencyProbe probe;
    LiveEngine engine(48000.0, {}, {});
    engine.add(drive);
    engine.add(narrow);
    engine.measure(probe);
    TrackedDrive tracked(drive, 48000.0, 44100.0, 480);
    std::vector<float> played(64);
    const test::HeapGuard guard;
    for (std::size_t i = 0; i < sound.size(); i += 96)
    {
        engine.process(std::span(sound).subspan(i, 96), 1);
        tracked.read(played);
    }
    CHECK(guard.traffic() == 0);
    CHECK(narrow.lost() > 9000);
}
