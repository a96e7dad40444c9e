#include "support/Catch.h"
#include "support/HeapGuard.h"

#include <pacini/linearize/PlayAndRecord.h>

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
SweepParams shortSweep()
{
    return {.duration = 0.5, .pause = 0.2, .markerDuration = 0.0, .sampleRate = 8000.0};
}

/// Runs `recorder` in a loop: input c is the output of `delay` frames before times c + 1.
std::vector<float> runLooped(PlayAndRecord& recorder, std::size_t frames, std::size_t block, std::size_t delay)
{
    std::vector<float> played(frames + delay, 0.0f); // played[n + delay] leaves at n
    for (std::size_t n = 0; n < frames; n += block)
    {
        const std::size_t count = std::min(block, frames - n);
        std::vector<float> first(played.begin() + static_cast<std::ptrdiff_t>(n),
                                 played.begin() + static_cast<std::ptrdiff_t>(n + count));
        std::vector<float> second(first);
        for (float& v : second)
            v *= 2.0f;
        const std::span<const float> inputs[] = {first, second};
        recorder.process(inputs, std::span(played).subspan(n + delay, count));
    }
    return played;
}
} // namespace

TEST_CASE("A measurement plays its signal once and records every input in step with it", "[linearize]")
{
    const auto signal = makeSweepSignal(shortSweep()).value();
    for (const std::size_t block : {1u, 64u, 511u, 512u})
    {
        CAPTURE(block);
        const std::size_t delay = 600;
        PlayAndRecord recorder;
        REQUIRE(recorder.prepare(shortSweep(), 3, 0.1).ok());
        recorder.start();
        CHECK(recorder.state() == PlayAndRecordState::idle); // until the audio thread has heard of it
        const auto played = runLooped(recorder, signal.size() + 2000, block, delay);
        CHECK(recorder.state() == PlayAndRecordState::finished);
        CHECK(recorder.progress() == 1.0);
        for (std::size_t n = 0; n < played.size() - delay; ++n)
            REQUIRE(played[n + delay] == (n < signal.size() ? signal[n] : 0.0f));
        const auto recording = recorder.recording();
        REQUIRE(recording.size() == 3);
        REQUIRE(recording[0].size() == signal.size() + 800);
        for (std::size_t n = 0; n < recording[0].size(); ++n)
        {
            const float expected = n >= delay && n - delay < signal.size() ? signal[n - delay] : 0.0f;
            REQUIRE(recording[0][n] == expected);
            REQUIRE(recording[1][n] == 2.0f * expected);
            REQUIRE(recording[2][n] == 0.0f); // not connected
        }
    }
}

TEST_CASE("A measurement is silent before its start, after its stop and after its end", "[linearize]")
{
    PlayAndRecord recorder;
    std::vector<float> out(100, 1.0f);
    recorder.start(); // nothing prepared
    recorder.process({}, out);
    CHECK(out == std::vector<float>(100, 0.0f));
    REQUIRE(recorder.prepare(shortSweep(), 1, 0.0).ok());
    std::vector<float> all(2400, 1.0f);
    recorder.process({}, all);
    CHECK(all == std::vector<float>(2400, 0.0f));
    CHECK(recorder.recording().empty());
    recorder.start();
    recorder.process({}, all);
    CHECK(recorder.state() == PlayAndRecordState::playing);
    CHECK(recorder.progress() > 0.2);
    CHECK(all != std::vector<float>(2400, 0.0f));
    CHECK(recorder.recording().empty());
    recorder.stop();
    recorder.process({}, all);
    CHECK(all == std::vector<float>(2400, 0.0f));
    CHECK(recorder.state() == PlayAndRecordState::idle);

    // Again from the beginning, beyond the end in one block.
    recorder.start();
    std::vector<float> whole(10000, 1.0f);
    recorder.process({}, whole);
    CHECK(recorder.state() == PlayAndRecordState::finished);
    const auto signal = makeSweepSignal(shortSweep()).value();
    for (std::size_t n = 0; n < whole.size(); ++n)
        REQUIRE(whole[n] == (n < signal.size() ? signal[n] : 0.0f));
}

TEST_CASE("The audio side of a measurement makes no heap traffic", "[linearize]")
{
    PlayAndRecord recorder;
    REQUIRE(recorder.prepare(shortSweep(), 2).ok());
    std::vector<float> out(512);
    std::vector<float> in(512, 0.25f);
    const std::span<const float> inputs[] = {in, in};
    const test::HeapGuard guard;
    recorder.start();
    for (int i = 0; i < 40; ++i)
        recorder.process(inputs, out);
    CHECK(recorder.state() == PlayAndRecordState::finished);
    CHECK(guard.traffic() == 0);
}

TEST_CASE("Input meters hold the largest sample until it is taken", "[linearize]")
{
    PlayAndRecord recorder;
    REQUIRE(recorder.prepare(shortSweep(), 1).ok());
    std::vector<float> out(64);
    std::vector<float> in(64, 0.0f);
    in[5] = -0.75f;
    const std::span<const float> inputs[] = {in};
    recorder.process(inputs, out);
    in[5] = 0.25f;
    recorder.process(inputs, out);
    CHECK(recorder.takePeak(0) == 0.75f);
    CHECK(recorder.takePeak(0) == 0.0f);
    CHECK(recorder.takePeak(7) == 0.0f);
    in[5] = std::numeric_limits<float>::quiet_NaN();
    recorder.process(inputs, out);
    CHECK(recorder.takePeak(0) == std::numeric_limits<float>::infinity());
}

TEST_CASE("A measurement that cannot be prepared says why", "[linearize]")
{
    PlayAndRecord recorder;
    CHECK(recorder.prepare(shortSweep(), 0).error().where == "channels");
    CHECK(recorder.prepare(shortSweep(), 4).error().where == "channels");
    CHECK(recorder.prepare(shortSweep(), 1, -1.0).error().where == "tail");
    auto params = shortSweep();
    params.levels = {};
    CHECK(recorder.prepare(params, 1).error().where == "levels");
}

TEST_CASE("A recorder takes one to three inputs and a tail of up to a minute, half a second by default", "[linearize]")
{
    PlayAndRecord recorder;
    CHECK(recorder.progress() == 0.0);
    CHECK(recorder.state() == PlayAndRecordState::idle);
    const std::vector<float> samples(100, 0.5f);
    for (const std::size_t channels : {1u, 3u})
        CHECK(recorder.prepare(samples, 1000.0, channels).ok());
    CHECK(recorder.prepare(samples, 1000.0, 0).error().message == "must be 1 to 3");
    CHECK(recorder.prepare(samples, 1000.0, 4).error().where == "channels");
    for (const double tail : {0.0, 60.0})
        CHECK(recorder.prepare(samples, 1000.0, 1, tail).ok());
    for (const double tail : {-0.001, 60.001, std::numeric_limits<double>::quiet_NaN()})
    {
        CHECK(recorder.prepare(samples, 1000.0, 1, tail).error().where == "tail");
        CHECK(recorder.prepare(samples, 1000.0, 1, tail).error().message == "must be 0 to 60 s");
    }
    const auto lengthOf = [&]
    {
        std::vector<float> out(20000);
        recorder.start();
        recorder.process({}, out);
        CHECK(recorder.state() == PlayAndRecordState::finished);
        CHECK(recorder.progress() == 1.0);
        return recorder.recording()[0].size();
    };
    REQUIRE(recorder.prepare(samples, 1000.0, 1).ok());
    CHECK(recorder.state() == PlayAndRecordState::idle); // prepared anew
    CHECK(lengthOf() == 600);
    REQUIRE(recorder.prepare(samples, 1000.0, 1, 0.0).ok());
    CHECK(recorder.progress() == 0.0);
    CHECK(lengthOf() == 100);
    REQUIRE(recorder.prepare(shortSweep(), 1).ok());
    CHECK(lengthOf() == makeSweepSignal(shortSweep())->size() + 4000);
}

TEST_CASE("A measurement that begins anew records anew, and every input has its meter", "[linearize]")
{
    PlayAndRecord recorder;
    std::vector<float> samples(40);
    for (std::size_t i = 0; i < 40; ++i)
        samples[i] = static_cast<float>(i + 1);
    REQUIRE(recorder.prepare(samples, 1000.0, 3, 0.01).ok());
    std::vector<float> out(30), in(30, 0.5f), loud(30, -0.75f), third(30, 0.0f), fourth(30, 9.0f);
    third[29] = std::numeric_limits<float>::max();
    const std::span<const float> inputs[] = {in, loud, third, fourth};
    recorder.start();
    recorder.process(inputs, out);
    CHECK(recorder.progress() == Approx(30.0 / 50.0));
    CHECK(out[29] == 30.0f);
    CHECK(recorder.takePeak(0) == 0.5f);
    CHECK(recorder.takePeak(1) == 0.75f);
    CHECK(recorder.takePeak(2) == std::numeric_limits<float>::max()); // finite
    CHECK(recorder.takePeak(3) == 0.0f);
    recorder.start();
    recorder.process(inputs, out);
    CHECK(out[0] == 1.0f);
    CHECK(recorder.progress() == Approx(30.0 / 50.0));
    recorder.process(inputs, out); // 20 more, of which ten are the tail
    CHECK(out[9] == 40.0f);
    CHECK(out[10] == 0.0f);
    CHECK(recorder.state() == PlayAndRecordState::finished);
    REQUIRE(recorder.recording().size() == 3);
    CHECK(recorder.recording()[1] == std::vector<float>(50, -0.75f));
    CHECK(recorder.takePeak(1) == 0.75f);
    recorder.process(std::span(inputs).first(1), out); // idle after the end, meters go on
    CHECK(out == std::vector<float>(30, 0.0f));
    CHECK(recorder.takePeak(0) == 0.5f);
    CHECK(recorder.recording()[1] == std::vector<float>(50, -0.75f));
    // an input that is missing is silence, over what was recorded before
    recorder.start();
    recorder.process(std::span(inputs).first(1), out);
    recorder.process(std::span(inputs).first(1), out);
    CHECK(recorder.recording()[0] == std::vector<float>(50, 0.5f));
    CHECK(recorder.recording()[1] == std::vector<float>(50, 0.0f));
    in[3] = std::numeric_limits<float>::infinity();
    in[4] = 0.25f;
    recorder.process(inputs, out);
    CHECK(recorder.takePeak(0) == std::numeric_limits<float>::infinity());
}
