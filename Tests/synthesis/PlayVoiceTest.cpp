#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/synthesis/PlayVoice.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
struct ReadPiece
{
    std::size_t from, to;
    CurvePiece piece;
};

std::vector<ReadPiece> piecesOf(const Curve& curve, std::size_t& next, std::int64_t now, std::size_t n, double fs)
{
    std::vector<ReadPiece> pieces;
    forCurvePieces(curve, next, now, n, fs,
                   [&](std::size_t i, std::size_t end, const CurvePiece& piece) {
                       pieces.push_back({i, end, piece});
                   });
    return pieces;
}

PlannedPlay steadyPlay(double level, double start, std::size_t actuators)
{
    PlannedPlay play;
    play.clip.duration = 0.02;
    play.clip.bands = {{90.0, 100.0, 110.0, 0, {{0.0, level}}, {}}};
    play.start = start;
    play.timeline.gains.assign(actuators, {{0.0, 1.0}});
    return play;
}

/// What a voice adds to `channels` actuators in `frames` frames of `fs` Hz, in blocks.
std::vector<std::vector<float>> mixed(const PlannedPlay& play, std::size_t channels, std::size_t frames,
                                      std::size_t block, bool lone = false, double fs = 8000.0)
{
    PlayVoice voice(play, play.timeline.gains.size(), fs);
    voice.prepare(play);
    const auto buffers = std::make_unique<MixBuffers>();
    std::vector<std::vector<float>> out(channels, std::vector<float>(frames, 0.0f));
    std::vector<std::span<float>> spans(out.begin(), out.end());
    for (std::size_t at = 0; at < frames && !voice.ended(); at += block)
        voice.mix(play, {spans, at, std::min(block, frames - at), static_cast<std::int64_t>(at)}, lone, *buffers);
    return out;
}

std::vector<float> aloneAt(const PlannedPlay& play, double fs)
{
    DecoderParams params = play.decoder;
    params.sampleRate = fs;
    Decoder decoder(play.clip, params, play.timeline.changes);
    std::vector<float> y(static_cast<std::size_t>(decoder.totalFrames()));
    decoder.process(y);
    return y;
}
} // namespace

TEST_CASE("A curve is read in straight pieces that begin on the first frame at or after its points", "[scene]")
{
    const double fs = 1024.0;
    const Curve curve = {
        {0.0102, 1.0}, {0.0202, 3.0}, {30.0 / 1024.0, 3.0}, {30.0 / 1024.0, 5.0}, {40.0 / 1024.0, 1.0}};
    std::size_t next = 0;
    const auto pieces = piecesOf(curve, next, 0, 60, fs);
    const std::size_t ends[] = {11, 21, 30, 40, 60};
    REQUIRE(pieces.size() == 5);
    for (std::size_t k = 0; k < 5; ++k)
    {
        CAPTURE(k);
        CHECK(pieces[k].from == (k == 0 ? 0u : ends[k - 1]));
        CHECK(pieces[k].to == ends[k]);
        CHECK(pieces[k].piece.fs == fs);
        for (std::size_t i = pieces[k].from; i < pieces[k].to; ++i)
            CHECK(pieces[k].piece.at(static_cast<std::int64_t>(i)) ==
                  Approx(valueAt(curve, static_cast<double>(i) / fs)));
    }
    CHECK(pieces[0].piece.slope == 0.0);
    CHECK(pieces[1].piece.slope == Approx(200.0));
    CHECK(pieces[1].piece.origin == 0.0102);
    CHECK(pieces[2].piece.slope == 0.0);
    CHECK(pieces[2].piece.origin == 0.0);
    CHECK(pieces[3].piece.slope == Approx(-409.6));
    CHECK(pieces[4].piece.slope == 0.0);
    CHECK(pieces[4].piece.value == 1.0);
    CHECK(next == curve.size());

    // Cut into blocks it is the same, and a block that ends before a point does not reach it.
    for (const std::size_t block : {std::size_t(1), std::size_t(7), std::size_t(10), std::size_t(11)})
    {
        next = 0;
        for (std::size_t at = 0; at < 60; at += block)
            for (const ReadPiece& part :
                 piecesOf(curve, next, static_cast<std::int64_t>(at), std::min(block, 60 - at), fs))
            {
                CHECK(part.from < part.to);
                CHECK(part.to <= block);
                for (std::size_t i = part.from; i < part.to; ++i)
                    CHECK(part.piece.at(static_cast<std::int64_t>(at + i)) ==
                          Approx(valueAt(curve, static_cast<double>(at + i) / fs)));
            }
    }
    // Points closer than a frame: one frame at least for each piece.
    next = 0;
    const auto close = piecesOf({{0.0011, 1.0}, {0.0012, 2.0}, {0.0013, 3.0}}, next, 0, 4, fs);
    REQUIRE(close.size() == 2);
    CHECK(close[0].to == 2);
    CHECK(close[1].piece.value == 3.0);
    next = 0;
    CHECK(piecesOf(curve, next, 0, 0, fs).empty());
    const CurvePiece usual;
    CHECK(usual.value == 0.0);
    CHECK(usual.slope == 0.0);
    CHECK(usual.origin == 0.0);
    CHECK(usual.fs == 1.0);
}

TEST_CASE("A delay tap reads whole frames exactly and between them the cubic through four", "[scene]")
{
    std::vector<float> x(40);
    std::uint32_t state = 7;
    for (float& v : x)
    {
        state = state * 1664525u + 1013904223u;
        v = static_cast<float>(state >> 8) / 16777216.0f - 0.5f;
    }
    for (const std::size_t block : {std::size_t(10), std::size_t(4), std::size_t(1)})
    {
        DelayTap tap(6.3, 10);
        tap.write(std::span<const float>(x).first(7)); // forgotten, like all that was never written
        tap.reset();
        const auto past = [&](std::ptrdiff_t i)
        {
            return i < 0 ? 0.0 : static_cast<double>(x[static_cast<std::size_t>(i)]);
        };
        for (std::size_t at = 0; at < x.size(); at += block)
        {
            tap.write(std::span<const float>(x).subspan(at, block));
            for (std::size_t n = 0; n < block; ++n)
                for (const double delay : {0.0, 0.25, 0.5, 1.0, 2.75, 3.0, 5.0, 5.3})
                {
                    // Lagrange's polynomial through the samples 0 to 3 behind the newest: one of them newer than the
                    // delay where there is one.
                    const auto newest = std::max<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::floor(delay)) - 1, 0);
                    const double u = delay - static_cast<double>(newest);
                    double wanted = 0.0;
                    for (int k = 0; k <= 3; ++k)
                    {
                        double weight = 1.0;
                        for (int j = 0; j <= 3; ++j)
                            if (j != k)
                                weight *= (u - j) / (k - j);
                        wanted += weight * past(static_cast<std::ptrdiff_t>(at + n) - newest - k);
                    }
                    if (delay == std::floor(delay))
                        CHECK(static_cast<double>(tap.read(n, delay)) ==
                              past(static_cast<std::ptrdiff_t>(at + n) - static_cast<std::ptrdiff_t>(delay)));
                    CAPTURE(at, n, delay);
                    CHECK(static_cast<double>(tap.read(n, delay)) == Approx(wanted).margin(1e-7));
                }
        }
        tap.reset();
        tap.write(std::span<const float>(x).first(1));
        CHECK(tap.read(0, 5.0) == 0.0f);
        CHECK(tap.read(0, 0.0) == x[0]);
    }
}

TEST_CASE("A voice starts on the frame nearest to its time and ends with its clip", "[scene]")
{
    const double fs = 8000.0;
    const PlannedPlay play = steadyPlay(0.5, 10.4 / fs, 1);
    const auto alone = aloneAt(play, fs);
    REQUIRE(alone.size() == 160);
    for (const auto& [start, frame] : {std::pair{10.4, 10}, {10.5, 11}, {0.0, 0}})
        CHECK(PlayVoice(steadyPlay(0.5, start / fs, 1), 1, fs).startFrame() == frame);
    for (const bool lone : {false, true})
        for (const std::size_t block :
             {std::size_t(1), std::size_t(7), std::size_t(10), std::size_t(11), std::size_t(170), std::size_t(300)})
        {
            CAPTURE(lone, block);
            const auto y = mixed(play, 1, 300, block, lone)[0];
            for (std::size_t n = 0; n < y.size(); ++n)
                REQUIRE(y[n] == (n >= 10 && n < 170 ? alone[n - 10] : 0.0f));
        }
    PlayVoice voice(play, 1, fs);
    CHECK_FALSE(voice.ended());
    CHECK(voice.decoding() == nullptr);
    voice.change(12.0, 1.0); // nothing to change yet
    voice.prepare(play);
    REQUIRE(voice.decoding() != nullptr);
    CHECK(voice.decoding()->totalFrames() == 160);
    const auto buffers = std::make_unique<MixBuffers>();
    std::vector<float> y(400, 0.0f);
    const std::span<float> span(y);
    const auto mix = [&](std::size_t at, std::size_t n)
    {
        voice.mix(play, {std::span(&span, 1), at, n, static_cast<std::int64_t>(at)}, false, *buffers);
    };
    mix(0, 10); // before its start
    CHECK_FALSE(voice.ended());
    mix(10, 159);
    CHECK_FALSE(voice.ended());
    mix(169, 1);
    CHECK(voice.ended());
    voice.release();
    CHECK(voice.decoding() == nullptr);
}

TEST_CASE("A voice adds its levels towards each actuator, and only a lone plain one overwrites", "[scene]")
{
    const double fs = 8000.0;
    PlannedPlay play = steadyPlay(0.5, 0.0, 3);
    play.timeline.gains = {{{0.0, 0.5}}, {{0.0, 0.0}}, {{0.005, 1.0}, {0.015, -1.0}}};
    const auto alone = aloneAt(play, fs);
    for (const std::size_t block : {std::size_t(160), std::size_t(13)})
    {
        const auto y = mixed(play, 3, 160, block);
        for (std::size_t n = 0; n < 160; ++n)
        {
            const double x = static_cast<double>(alone[n]);
            CHECK(static_cast<double>(y[0][n]) == Approx(0.5 * x).margin(1e-9));
            CHECK(y[1][n] == 0.0f);
            const double gain = std::clamp(2.0 - static_cast<double>(n) / 40.0, -1.0, 1.0);
            CHECK(static_cast<double>(y[2][n]) == Approx(gain * x).margin(1e-7));
        }
    }
    // Fewer outputs than actuators, or more: those that both have.
    CHECK(mixed(play, 1, 160, 160)[0] == mixed(play, 3, 160, 160)[0]);
    const auto more = mixed(play, 4, 160, 160);
    CHECK(more[2] == mixed(play, 3, 160, 160)[2]);
    CHECK(more[3] == std::vector<float>(160, 0.0f));

    // What was there stays, unless the voice is alone and goes to one actuator as it is.
    const auto over = [&](const PlannedPlay& planned, bool lone, double live)
    {
        PlayVoice voice(planned, planned.timeline.gains.size(), fs);
        voice.prepare(planned);
        voice.setFader(Fader::play, live, 0);
        const auto buffers = std::make_unique<MixBuffers>();
        std::vector<std::vector<float>> out(planned.timeline.gains.size(), std::vector<float>(160, 5.0f));
        std::vector<std::span<float>> spans(out.begin(), out.end());
        voice.mix(planned, {spans, 0, 160, 0}, lone, *buffers);
        return out[0][0];
    };
    const PlannedPlay plain = steadyPlay(0.5, 0.0, 1);
    CHECK(over(plain, true, 1.0) == alone[0]);
    CHECK(over(plain, false, 1.0) == alone[0] + 5.0f);
    CHECK(over(plain, true, 0.5) == alone[0] + 5.0f);
    CHECK(over(steadyPlay(0.5, 0.0, 2), true, 1.0) == alone[0] + 5.0f);
    {
        // One span for a play on two actuators.
        const PlannedPlay two = steadyPlay(0.5, 0.0, 2);
        PlayVoice voice(two, 2, fs);
        voice.prepare(two);
        const auto buffers = std::make_unique<MixBuffers>();
        std::vector<float> out(160, 5.0f);
        const std::span<float> span(out);
        voice.mix(two, {std::span(&span, 1), 0, 160, 0}, true, *buffers);
        CHECK(out[0] == alone[0] + 5.0f);
    }
    PlannedPlay quieter = plain;
    quieter.timeline.gains = {{{0.0, 0.5}}};
    CHECK(over(quieter, true, 1.0) == 0.5f * alone[0] + 5.0f);
    quieter.timeline.gains = {{{0.0, 1.0}, {1.0, 0.0}}};
    CHECK(over(quieter, true, 1.0) == alone[0] + 5.0f);
    // A gain that rises by 1 a second, and where a block is mixed to unless told otherwise.
    PlannedPlay rising = plain;
    rising.timeline.gains = {{{0.0, 0.0}, {1.0, 1.0}}};
    const auto slow = mixed(rising, 1, 160, 160)[0];
    for (std::size_t n = 0; n < 160; ++n)
        CHECK(static_cast<double>(slow[n]) ==
              Approx(static_cast<double>(n) / fs * static_cast<double>(alone[n])).margin(1e-8));
    const MixTarget target;
    CHECK(target.at == 0);
    CHECK(target.frames == 0);
    CHECK(target.now == 0);
}

TEST_CASE("A delayed voice comes later by its delays, sounds longer, and never comes early", "[scene]")
{
    const double fs = 8000.0;
    PlannedPlay play = steadyPlay(0.5, 10.0 / fs, 2);
    play.timeline.gains = {{{0.0, 1.0}}, {{0.0, 1.0}}};
    play.timeline.delays = {{{0.0, 4.999999999 / fs}}, {{0.0, 0.0}, {0.01, -0.001}}};
    const auto alone = aloneAt(play, fs);
    for (const std::size_t block : {std::size_t(1), std::size_t(16), std::size_t(300)})
    {
        CAPTURE(block);
        const auto y = mixed(play, 2, 300, block);
        for (std::size_t n = 0; n < 300; ++n)
        {
            const auto late = [&](std::size_t frames)
            {
                return n >= 10 + frames && n < 170 + frames ? alone[n - 10 - frames] : 0.0f;
            };
            REQUIRE(y[0][n] == Approx(late(5)).margin(1e-6));
            REQUIRE(y[1][n] == Approx(late(0)).margin(1e-6));
        }
    }
    // It ends when the longest delay and the frames of the cubic behind it are over.
    PlayVoice voice(play, 2, fs);
    voice.prepare(play);
    const auto buffers = std::make_unique<MixBuffers>();
    std::vector<float> a(400), b(400);
    const std::span<float> both[] = {a, b};
    voice.mix(play, {both, 0, 177, 0}, false, *buffers);
    CHECK_FALSE(voice.ended());
    voice.mix(play, {both, 177, 1, 177}, false, *buffers);
    CHECK(voice.ended());
    // Delays that move: 48 to 0 frames and back.
    play.clip.duration = 0.1;
    play.timeline.delays = {{{0.0, 0.006}, {0.05, 0.0}, {0.1, 0.0061}}, {{0.02, 0.001}, {0.03, 0.004}}};
    play.timeline.gains = {{{0.0, 1.0}, {0.1, 0.3}}, {{0.0, -0.7}}};
    play.timeline.changes = {{0.04, 5.0, 0.7}};
    const auto moving = mixed(play, 2, 1000, 64);
    checkPinned("synthesis/a voice with moving delays", std::vector<double>(moving[0].begin(), moving[0].end()), 1e-5);
    checkPinned("synthesis/a voice with moving delays, second actuator",
                std::vector<double>(moving[1].begin(), moving[1].end()), 1e-5);
    CHECK(mixed(play, 2, 1000, 1000) == moving);
    CHECK(mixed(play, 2, 1000, 17) == moving);
    play.clip.duration = 0.2;
    CHECK(mixed(play, 2, 1500, 1024) == mixed(play, 2, 1500, 64)); // blocks as long as the memory
}

TEST_CASE("A live change of a voice is that of its decoder", "[scene]")
{
    const double fs = 8000.0;
    PlannedPlay play = steadyPlay(0.5, 0.0, 1);
    play.clip.duration = 0.2;
    play.decoder.headroom = 24.0;
    PlayVoice voice(play, 1, fs);
    voice.prepare(play);
    DecoderParams params = play.decoder;
    params.sampleRate = fs;
    Decoder decoder(play.clip, params);
    const auto buffers = std::make_unique<MixBuffers>();
    std::vector<float> y(1600, 0.0f), wanted(1600, 0.0f);
    const std::span<float> span(y);
    voice.mix(play, {std::span(&span, 1), 0, 400, 0}, false, *buffers);
    decoder.process(std::span(wanted).first(400));
    voice.change(12.0, 0.9);
    decoder.change(12.0, 0.9);
    voice.mix(play, {std::span(&span, 1), 400, 1024, 400}, false, *buffers);
    decoder.process(std::span(wanted).subspan(400, 1024));
    CHECK(y == wanted);
    CHECK(voice.decoding()->totalFrames() < 1600);
}
