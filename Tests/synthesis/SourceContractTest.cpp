#include "support/ActuatorOf.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/ClipSamples.h"
#include "support/Measure.h"
#include "support/Render.h"

#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// A player of one actuator as a source.
class OneActuator
{
public:
    OneActuator(const RenderPlan& plan, double fs) : player(plan, {.sampleRate = fs}) {}

    [[nodiscard]] std::int64_t totalFrames() const { return player.totalFrames(); }
    void process(std::span<float> out) { player.process(std::span(&out, 1)); }

    ScenePlayer player;
};

/// A short clip with bands that glide and step, an envelope, noise, events and amplitudes down to the denormals.
Clip everything()
{
    Clip clip;
    clip.duration = 0.12;
    clip.envelope = {{0.0, 0.2}, {0.05, 0.9}, {0.1, 0.0}};
    clip.centroid = {{0.0, 100.0}};
    clip.bands = {
        {60.0, 80.0, 100.0, 0, {{0.0, 0.0}, {0.03, 0.8}, {0.03, 0.1}, {0.12, 0.4}}, {{0.0, 70.0}, {0.1, 99.0}}},
        {150.0, 200.0, 250.0, 1, {{0.0, 5e-324}, {0.05, 1e-310}, {0.12, 0.5}}, {}},
        {700.0, 800.0, 1000.0, 2, {{0.0, 1e-38}, {0.12, 1e-40}}, {{0.0, 990.0}}}};
    clip.transients = {{0.01, 1.0, 0.2}, {0.05, 0.7, 1.0}, {0.06, 1e-320, 0.5}};
    clip.noise = {{100.0, 200.0, {{0.0, 0.1}, {0.12, 1e-310}}}};
    return clip;
}

Scene sceneWithGain(const Clip& clip, double gain = 0.0)
{
    Scene scene;
    scene.clips = {clip};
    scene.plays.resize(1);
    scene.gain = gain;
    return scene;
}

Profile actuator(Technology technology)
{
    Profile profile = test::actuatorOf(technology, {175.0, 10.0}, {80.0, 300.0, 40.0});
    profile.polyphony = 2;
    return profile;
}

/// Hz, from the zero crossings of the middle half.
double pitchOf(const std::vector<float>& y, double fs)
{
    std::size_t first = 0, last = 0, count = 0;
    for (std::size_t n = y.size() / 4; n < 3 * y.size() / 4; ++n)
        if (y[n - 1] < 0.0f && y[n] >= 0.0f)
        {
            first = count++ == 0 ? n : first;
            last = n;
        }
    REQUIRE(count > 10);
    return static_cast<double>(count - 1) * fs / static_cast<double>(last - first);
}
} // namespace

TEST_CASE("A decoder keeps the contract of sources", "[synthesis][contract]")
{
    for (const bool levelled : {true, false})
        for (const bool delayed : {false, true})
            checkSourceContract(
                [&](double fs)
                {
                    DecoderParams params;
                    params.sampleRate = fs;
                    params.followEnvelope = levelled;
                    params.delay = delayed ? 0.01 : 0.0;
                    std::vector<DecoderChange> changes = {{0.04, 12.0, 0.5}, {0.06, -100.0, 3.0}};
                    if (!delayed)
                        changes.clear();
                    return std::make_unique<Decoder>(everything(), params, changes);
                },
                10.0);
}

TEST_CASE("A scene keeps the contract of sources with and without a profile", "[scene][contract]")
{
    for (const double gain : {0.0, 60.0})
    {
        const auto plan = compilePlan(sceneWithGain(everything(), gain));
        REQUIRE(plan.ok());
        checkSourceContract([&](double fs) { return std::make_unique<OneActuator>(*plan, fs); }, 1.0);
        for (const Technology technology : {Technology::lra, Technology::erm, Technology::pcm})
        {
            const Profile profile = actuator(technology);
            const auto adapted = compilePlan(sceneWithGain(everything(), gain), &profile);
            REQUIRE(adapted.ok());
            checkSourceContract([&](double fs) { return std::make_unique<OneActuator>(*adapted, fs); }, 1.0, true);
        }
    }
}

TEST_CASE("A decoder ignores changes that are not finite and stays finite through all others", "[synthesis]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    Decoder plain(everything(), {});
    const auto expected = render(plain, 64);
    for (const auto& [transposition, stretch] : {std::pair(nan, 1.0), std::pair(0.0, nan), std::pair(inf, 1.0),
                                                 std::pair(0.0, inf), std::pair(-inf, -inf), std::pair(nan, nan)})
    {
        CAPTURE(transposition, stretch);
        Decoder decoder(everything(), {}, {{0.02, transposition, stretch}, {nan, 0.0, 1.0}});
        std::vector<float> y(expected.size());
        for (std::size_t i = 0; i < y.size(); i += 64)
        {
            decoder.process(std::span(y).subspan(i, std::min<std::size_t>(64, y.size() - i)));
            decoder.change(transposition, stretch);
        }
        CHECK(y == expected);
        CHECK(decoder.totalFrames() == plain.totalFrames());
    }
    Random random(3);
    const auto any = [&]
    {
        return anyNumber[random.next() % std::size(anyNumber)];
    };
    for (int run = 0; run < 20; ++run)
    {
        DecoderParams params;
        params.transposition = any();
        params.stretch = any();
        params.gain = any();
        params.headroom = any();
        params.reach = any();
        params.variation.amount = any();
        params.pulses = {static_cast<TransientShape>(run % 3), any(), any(), any(), any()};
        Decoder decoder(everything(), params, {{0.01, any(), any()}});
        std::vector<float> y(64);
        for (int i = 0; i < 200; ++i)
        {
            decoder.process(y);
            REQUIRE(allFinite(y));
            if (i % 10 == 0)
                decoder.change(any(), any());
        }
    }
}

TEST_CASE("A scene ignores live values that are not finite and keeps full drive through all others", "[scene]")
{
    const auto plan = compilePlan(sceneWithGain(everything()));
    REQUIRE(plan.ok());
    const auto play = [&](auto&& change)
    {
        OneActuator source(*plan, 48000.0);
        std::vector<float> y(static_cast<std::size_t>(source.totalFrames()));
        for (std::size_t i = 0; i < y.size(); i += 48)
        {
            source.process(std::span(y).subspan(i, std::min<std::size_t>(48, y.size() - i)));
            change(source.player);
        }
        return y;
    };
    const auto expected = play([](ScenePlayer&) {});
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()})
    {
        CAPTURE(bad);
        CHECK(play([bad](ScenePlayer& player) { player.setGain(0, bad); }) == expected);
        CHECK(play([bad](ScenePlayer& player) { player.setPitchAndSpeed(0, bad, 1.0); }) == expected);
        CHECK(play([bad](ScenePlayer& player) { player.setPitchAndSpeed(0, 0.0, bad); }) == expected);
    }
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
        CAPTURE(seed);
        Random random(seed);
        const auto any = [&]
        {
            return anyNumber[random.next() % std::size(anyNumber)];
        };
        const auto y = play(
            [&](ScenePlayer& player)
            {
                player.setGain(random.next() % 3, any());
                player.setPitchAndSpeed(random.next() % 3, any(), any());
            });
        REQUIRE(allFinite(y));
        CHECK(std::all_of(y.begin(), y.end(), [](float v) { return std::abs(v) <= 1.0f; }));
    }
}

TEST_CASE("A gain that was far too large leaves nothing behind", "[scene]")
{
    const auto plan = compilePlan(sceneWithGain(test::steadyClip(100.0, 0.5, 4.0)));
    REQUIRE(plan.ok());
    OneActuator source(*plan, 8000.0);
    std::vector<float> y(32000);
    for (std::size_t i = 0; i < y.size(); i += 80)
    {
        source.player.setGain(0, i < 8000 ? 1e30 : 1.0);
        source.process(std::span(y).subspan(i, 80));
    }
    CHECK(std::all_of(y.begin(), y.end(), [](float v) { return std::abs(v) <= 1.0f; }));
    CHECK(rms(std::span(y).last(8000)) == Approx(0.5 / std::sqrt(2.0)).epsilon(1e-3));
}

TEST_CASE("A clip has its pitch, level and length at every rate up to 768 kHz", "[synthesis][scene]")
{
    for (const double fs : {2000.0, 8000.0, 44100.0, 48000.0, 96000.0, 192000.0, 384000.0, 705600.0, 768000.0})
    {
        CAPTURE(fs);
        CompileParams params;
        params.sampleRate = fs;
        const auto plan = compilePlan(sceneWithGain(test::steadyClip(160.0, 0.5, 0.4)), nullptr, params);
        REQUIRE(plan.ok());
        OneActuator source(*plan, fs);
        REQUIRE(source.totalFrames() == std::llround(0.4 * fs));
        std::vector<float> y(static_cast<std::size_t>(source.totalFrames()));
        source.process(y);
        CHECK(pitchOf(y, fs) == Approx(160.0).epsilon(2e-3));
        CHECK(rms(std::span(y).subspan(y.size() / 4, y.size() / 2)) == Approx(0.5 / std::sqrt(2.0)).epsilon(0.01));
        DecoderParams decoding;
        decoding.sampleRate = fs;
        Decoder decoder(test::steadyClip(160.0, 0.5, 0.4), decoding);
        REQUIRE(decoder.totalFrames() == source.totalFrames());
        CHECK(pitchOf(render(decoder, 4096), fs) == Approx(160.0).epsilon(2e-3));
    }
}

TEST_CASE("A rate that nothing plays at is an error of the plan and silence of the player, never another pitch",
          "[synthesis][scene]")
{
    const Scene scene = sceneWithGain(test::steadyClip(160.0, 0.5, 0.4));
    const auto plan = compilePlan(scene);
    REQUIRE(plan.ok());
    for (const double fs : {0.0, -48000.0, 1999.0, 768001.0, 1536000.0, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()})
    {
        CAPTURE(fs);
        CompileParams params;
        params.sampleRate = fs;
        const auto refused = compilePlan(scene, nullptr, params);
        REQUIRE_FALSE(refused.ok());
        CHECK(refused.error().where == "sampleRate");
        OneActuator source(*plan, fs);
        DecoderParams decoding;
        decoding.sampleRate = fs;
        Decoder decoder(scene.clips[0], decoding);
        CHECK(source.totalFrames() == 0);
        CHECK(decoder.totalFrames() == 0);
        std::vector<float> y(4096, 1.0f);
        source.process(y);
        CHECK(rms(y) == 0.0);
        std::fill(y.begin(), y.end(), 1.0f);
        decoder.process(y);
        CHECK(rms(y) == 0.0);
    }
}
