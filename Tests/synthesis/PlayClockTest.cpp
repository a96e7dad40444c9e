#include "support/Catch.h"
#include "support/ClipSamples.h"
#include "support/HeapGuard.h"
#include "support/Render.h"

#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/PlayTimeline.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

using namespace pacini;
using test::render;

namespace
{
/// Upward zero crossings per second between two times.
double frequencyIn(std::span<const float> y, double fs, double from, double to)
{
    double first = -1.0, last = -1.0;
    int count = -1;
    for (auto n = static_cast<std::size_t>(from * fs); n + 1 < static_cast<std::size_t>(to * fs); ++n)
        if (y[n] <= 0.0f && y[n + 1] > 0.0f)
        {
            last = static_cast<double>(n) + static_cast<double>(-y[n] / (y[n + 1] - y[n]));
            first = first < 0.0 ? last : first;
            ++count;
        }
    return count > 0 ? fs * count / (last - first) : 0.0;
}

Clip wideTone(double hertz, double seconds)
{
    Clip clip;
    clip.duration = seconds;
    clip.bands = {{20.0, hertz, 1000.0, 0, {{0.0, 0.5}, {seconds, 0.5}}, {}}};
    return clip;
}
} // namespace

TEST_CASE("Clock pieces join without gaps, and frameOf undoes clipAt", "[synthesis]")
{
    PlayClock clock(3);
    clock.change(100.0, 2.0, 1.0);
    clock.change(150.5, 0.25, 3.0);
    clock.change(120.0, 1.0, 1.0); // too late: comes at 150.5
    CHECK(clock.clipAt(100.0) == 100.0);
    CHECK(clock.clipAt(150.5) == 201.0);
    CHECK(clock.clipAt(160.5) == 211.0);
    for (double frame : {0.0, 99.9, 100.0, 130.0, 151.0, 1e9})
        CHECK(clock.frameOf(clock.clipAt(frame)) == Approx(frame).epsilon(1e-14));
    CHECK(clock.nextChange(0.0) == 100.0);
    CHECK(std::isinf(clock.nextChange(200.0)));
}

TEST_CASE("The clock of a play runs at the stretch of each of its changes", "[synthesis]")
{
    PlayTimeline timeline;
    timeline.changes = {{1.0, 0.0, 0.5}, {2.0, 7.0, 4.0}};
    const PlayClock clock = makeClock(2.0, timeline);
    // Half a second of the clip in the first second, two in the next, a quarter of one in each after that.
    for (const auto& [time, clipTime] :
         {std::pair{0.0, 0.0}, {0.5, 0.25}, {1.0, 0.5}, {1.5, 1.5}, {2.0, 2.5}, {6.0, 3.5}})
    {
        CAPTURE(time);
        CHECK(clock.clipAt(time) == Approx(clipTime));
        CHECK(clock.frameOf(clipTime) == Approx(time));
    }
}

TEST_CASE("A scheduled transposition comes on its sample and keeps the phase", "[synthesis]")
{
    const double fs = 48000.0;
    Decoder decoder(wideTone(100.0, 2.0), {}, {{1.0, 12.0, 1.0}});
    const auto y = render(decoder, 100);
    CHECK(frequencyIn(y, fs, 0.1, 0.98) == Approx(100.0).epsilon(1e-4));
    CHECK(frequencyIn(y, fs, 1.02, 1.9) == Approx(200.0).epsilon(1e-4));
    // 100 whole cycles before the change, so 200 Hz from zero after it.
    for (double t : {1.0 + 1.0 / 800.0, 1.5 + 1.0 / 800.0})
        CHECK(static_cast<double>(y[static_cast<std::size_t>(t * fs)]) == Approx(0.5).epsilon(1e-3));
    for (std::size_t n = 1; n < y.size(); ++n)
        REQUIRE(std::abs(y[n] - y[n - 1]) < 0.5f * 2.0f * 3.1416f * 200.0f / 48000.0f * 1.2f);
}

TEST_CASE("A scheduled stretch moves all that follows: curves, events and the end", "[synthesis]")
{
    Clip clip = wideTone(100.0, 2.0);
    clip.bands[0].amplitude = {{0.0, 0.0}, {1.5, 0.0}, {1.501, 0.5}, {2.0, 0.5}};
    clip.transients = {{0.5, 0.8, 0.5}, {1.25, 0.8, 0.5}};
    const DecoderParams params;
    Decoder decoder(clip, params, {{1.0, 0.0, 2.0}});
    CHECK(decoder.totalFrames() == 3 * 48000);
    const auto y = render(decoder, 333);
    const auto loudest = [&](double from, double to)
    {
        float peak = 0.0f;
        for (auto n = static_cast<std::size_t>(from * 48000.0); n < static_cast<std::size_t>(to * 48000.0); ++n)
            peak = std::max(peak, std::abs(y[n]));
        return peak;
    };
    CHECK(loudest(0.0, 0.4999) < 1e-3f);
    CHECK(loudest(0.5, 0.52) > 0.5f);
    CHECK(loudest(0.53, 1.4999) < 1e-3f);
    CHECK(loudest(1.5, 1.52) > 0.5f); // 1.25 s of the clip
    CHECK(loudest(1.53, 1.99) < 2e-3f);
    CHECK(loudest(2.02, 2.9) > 0.4f); // 1.5 s of the clip
    CHECK(frequencyIn(y, 48000.0, 2.1, 2.9) == Approx(100.0).epsilon(1e-4));
}

TEST_CASE("Scheduled changes do not depend on the block size, and reset starts over with them", "[synthesis]")
{
    for (std::uint64_t seed = 1; seed < 8; ++seed)
    {
        CAPTURE(seed);
        DecoderParams params;
        params.delay = 0.01;
        Decoder decoder(test::randomClip(seed), params,
                        {{0.05, 3.0, 1.3}, {0.0501, -5.0, 0.7}, {0.2, 0.0, 1.0}, {0.2, 7.0, 3.0}});
        const auto whole = render(decoder, 1u << 20);
        for (std::size_t block : {std::size_t(1), std::size_t(7), std::size_t(511)})
        {
            decoder.reset();
            REQUIRE((render(decoder, block) == whole));
        }
    }
}

TEST_CASE("A change to what already plays changes nothing", "[synthesis]")
{
    const Clip clip = test::randomClip(3);
    Decoder plain(clip, {});
    Decoder changed(clip, {}, {{0.1, 0.0, 1.0}});
    const auto a = render(plain, 4096), b = render(changed, 4096);
    REQUIRE(a.size() == b.size());
    for (std::size_t n = 0; n < a.size(); ++n)
        REQUIRE(std::abs(a[n] - b[n]) < 1e-6f);
}

TEST_CASE("A live change is heard within 40 ms and needs no memory", "[synthesis][realtime]")
{
    DecoderParams params;
    params.headroom = 12.0;
    Decoder decoder(wideTone(100.0, 3.0), params);
    std::vector<float> y(144000);
    decoder.process(std::span(y).first(48000));
    {
        const test::HeapGuard guard;
        for (int i = 0; i < 1000; ++i)
            decoder.change(static_cast<double>(i % 12), 1.0 + 0.001 * i);
        decoder.change(12.0, 1.0);
        decoder.process(std::span(y).subspan(48000));
        CHECK(guard.traffic() == 0);
    }
    CHECK(frequencyIn(y, 48000.0, 0.5, 1.0) == Approx(100.0).epsilon(1e-3));
    CHECK(frequencyIn(y, 48000.0, 1.04, 2.5) == Approx(200.0).epsilon(1e-3));
}

TEST_CASE("A clock runs as it is until it is told otherwise", "[synthesis]")
{
    const ClockPiece piece;
    CHECK(piece.from == 0.0);
    CHECK(piece.clip == 0.0);
    CHECK(piece.rate == 1.0);
    CHECK(piece.pitch == 1.0);
    const ClockPiece fast{10.0, 4.0, 2.0, 1.0};
    CHECK(fast.clipAt(13.0) == 10.0);
    CHECK(fast.frameOf(10.0) == 13.0);
    PlayClock clock;
    CHECK(clock.untouched());
    CHECK(clock.clipAt(5.0) == 5.0);
    CHECK(clock.clipAt(-5.0) == -5.0);
    CHECK(clock.frameOf(-5.0) == -5.0);
    CHECK(std::isinf(clock.nextChange(0.0)));
    clock.change(0.0, 1.0, 1.0); // that is what it does already
    CHECK(clock.untouched());
    clock.change(0.0, 1.0, 2.0);
    CHECK_FALSE(clock.untouched());
    CHECK(clock.pieceAt(0.0).pitch == 2.0);
    clock.reset();
    CHECK(clock.untouched());
    clock.change(7.0, 1.0, 1.0);
    CHECK_FALSE(clock.untouched());
}

TEST_CASE("A clock has room for scheduled changes and 64 more, then the last one is replaced", "[synthesis]")
{
    for (const std::size_t scheduled : {std::size_t(0), std::size_t(5)})
    {
        PlayClock clock(scheduled);
        const std::size_t room = scheduled + 64;
        for (std::size_t i = 1; i <= room; ++i)
            clock.change(static_cast<double>(i), 1.0, 1.0 + static_cast<double>(i));
        for (std::size_t i = 0; i <= room; ++i)
            CHECK(clock.pieceAt(static_cast<double>(i)).pitch == 1.0 + static_cast<double>(i));
        clock.change(1000.0, 1.0, 0.5);
        CHECK(clock.pieceAt(static_cast<double>(room)).pitch == static_cast<double>(room));
        CHECK(clock.pieceAt(1000.0).pitch == 0.5);
        CHECK(clock.clipAt(2000.0) == 2000.0);
        // What is forgotten makes room.
        clock.forgetBefore(3.0);
        CHECK(clock.pieceAt(0.0).pitch == 4.0);
        clock.change(1500.0, 1.0, 9.0);
        CHECK(clock.pieceAt(1499.0).pitch == 0.5);
        CHECK(clock.pieceAt(1500.0).pitch == 9.0);
    }
}

TEST_CASE("Changes after a frame are dropped, those on it stay", "[synthesis]")
{
    const auto withThree = []
    {
        PlayClock clock(3);
        clock.change(10.0, 2.0, 1.0);
        clock.change(20.0, 0.5, 2.0);
        clock.change(30.0, 4.0, 3.0);
        return clock;
    };
    PlayClock clock = withThree();
    CHECK(clock.nextChange(-1.0) == 0.0);
    CHECK(clock.nextChange(0.0) == 10.0);
    CHECK(clock.nextChange(9.9) == 10.0);
    CHECK(clock.nextChange(10.0) == 20.0);
    CHECK(clock.clipAt(30.0) == 35.0);
    CHECK(clock.frameOf(35.0) == 30.0);
    CHECK(clock.frameOf(39.0) == 31.0);
    clock.dropAfter(30.0);
    CHECK(clock.nextChange(20.0) == 30.0);
    clock.dropAfter(29.9);
    CHECK(std::isinf(clock.nextChange(20.0)));
    clock.dropAfter(-5.0);
    CHECK(clock.untouched());
    clock = withThree();
    clock.forgetBefore(20.0);
    CHECK(clock.pieceAt(0.0).from == 20.0);
    CHECK(clock.clipAt(20.0) == 30.0);
    clock.forgetBefore(0.0);
    CHECK(clock.pieceAt(0.0).from == 20.0);
    // A change on the frame of the last one takes its place.
    clock.change(30.0, 1.0, 7.0);
    CHECK(clock.pieceAt(30.0).pitch == 7.0);
    CHECK(clock.pieceAt(30.0).clip == 35.0);
    CHECK(clock.pieceAt(29.9).pitch == 2.0);
}
