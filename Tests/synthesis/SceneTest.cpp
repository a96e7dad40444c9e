#include "support/Catch.h"
#include "support/ClipSamples.h"
#include "support/HeapGuard.h"
#include "support/Measure.h"
#include "support/Render.h"
#include "support/ShippedProfile.h"

#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace pacini;
using test::Channels;

namespace
{
Channels render(const Scene& scene, const CompileParams& params = {}, const Profile* profile = nullptr,
                std::size_t block = 1000)
{
    const auto plan = compilePlan(scene, profile, params);
    REQUIRE(plan.ok());
    ScenePlayer player(*plan, {.sampleRate = params.sampleRate});
    return test::renderChannels(player, player.actuators(), block);
}

CompileParams playEverything()
{
    CompileParams params;
    params.leaveOut = false;
    return params;
}

Clip tone(double hertz, double seconds, double amplitude = 0.5)
{
    Clip clip;
    clip.name = "tone";
    clip.duration = seconds;
    clip.bands = {{hertz, hertz, hertz, 0, {{0.0, amplitude}, {seconds, amplitude}}, {}}};
    return clip;
}

double energy(const Channels& y)
{
    double sum = 0.0;
    for (const auto& channel : y)
        for (float v : channel)
            sum += static_cast<double>(v) * static_cast<double>(v);
    return sum;
}

double errorInDecibels(const Channels& y, const Channels& wanted)
{
    Channels difference = y;
    for (std::size_t a = 0; a < y.size(); ++a)
        for (std::size_t n = 0; n < y[a].size(); ++n)
            difference[a][n] -= wanted[a][n];
    return 10.0 * std::log10(energy(difference) / energy(wanted));
}

double rms(const std::vector<float>& y, double from, double to)
{
    double sum = 0.0;
    const auto a = static_cast<std::size_t>(from * 48000.0), b = static_cast<std::size_t>(to * 48000.0);
    for (std::size_t n = a; n < b; ++n)
        sum += static_cast<double>(y[n]) * static_cast<double>(y[n]);
    return std::sqrt(sum / static_cast<double>(b - a));
}

/// A scene of random clips, `audible` of them as they are and the others between -70 and -100 dB.
Scene crowd(std::uint64_t seed, std::size_t count, std::size_t audible)
{
    Random random(seed);
    Scene scene;
    scene.duration = 1.0;
    for (std::size_t i = 0; i < count; ++i)
    {
        scene.clips.push_back(test::randomClip(seed * 1000 + i));
        ScenePlay play;
        play.clip = i;
        play.start = random.uniform(0.0, 0.3);
        play.gain = i < audible ? random.uniform(-12.0, 0.0) : random.uniform(-100.0, -70.0);
        scene.plays.push_back(play);
    }
    return scene;
}
} // namespace

TEST_CASE("A scene of one play is that clip, within full drive", "[scene]")
{
    for (std::uint64_t seed = 1; seed < 6; ++seed)
    {
        CAPTURE(seed);
        Scene scene;
        scene.clips = {test::randomClip(seed)};
        scene.plays = {ScenePlay{}};
        Decoder decoder(scene.clips[0], {});
        std::vector<float> alone(static_cast<std::size_t>(decoder.totalFrames()));
        decoder.process(alone);
        const auto peakOf = [](const std::vector<float>& y)
        {
            float peak = 0.0f;
            for (float v : y)
                peak = std::max(peak, std::abs(v));
            return peak;
        };
        const auto plan = compilePlan(scene, nullptr, playEverything());
        REQUIRE(plan.ok());
        ScenePlayer plain(*plan, {.protect = false});
        CHECK((test::renderChannels(plain, 1, 1000).front() == alone));
        CHECK(plain.maxReduction() == 0.0);
        REQUIRE(peakOf(alone) > 1.0f);
        ScenePlayer kept(*plan);
        const auto within = test::renderChannels(kept, 1, 1000).front();
        CHECK(peakOf(within) <= 1.0f);
        CHECK(peakOf(within) > 0.95f);
        CHECK(kept.maxReduction() == Approx(20.0 * std::log10(static_cast<double>(peakOf(alone)))).epsilon(1e-4));
        // Half as loud it stays within full drive by itself, and is what it was bit for bit.
        scene.gain = -20.0 * std::log10(1.1 * static_cast<double>(peakOf(alone)));
        const auto soft = compilePlan(scene, nullptr, playEverything());
        ScenePlayer quiet(*soft), quietPlain(*soft, {.protect = false});
        CHECK((test::renderChannels(quiet, 1, 1000) == test::renderChannels(quietPlain, 1, 1000)));
        CHECK(quiet.maxReduction() == 0.0);
    }
}

TEST_CASE("A scene does not depend on the block size", "[scene]")
{
    Scene scene = crowd(3, 6, 6);
    scene.actuators = 3;
    scene.panLaw = PanLaw::both;
    scene.plays[1].pan = 0.2;
    scene.plays[2].loop = 0.05;
    scene.plays[2].variation = {0.5, VariationScope::breakpoint, 4};
    scene.changes = {{0.1, 0, SceneParameter::gain, -20.0, 0.05},
                     {0.2, 1, SceneParameter::pan, 1.0, 0.3},
                     {0.3, 3, SceneParameter::transposition, 5.0, 0.0},
                     {0.4, 3, SceneParameter::stretch, 0.5, 0.0},
                     {0.5, 4, SceneParameter::gain, -130.0, 0.0}};
    const auto plan = compilePlan(scene);
    REQUIRE(plan.ok());
    const auto whole = [&](std::size_t block)
    {
        ScenePlayer player(*plan);
        return test::renderChannels(player, player.actuators(), block);
    };
    const auto reference = whole(1u << 20);
    CHECK(energy(reference) > 1.0);
    for (std::size_t block : {std::size_t(1), std::size_t(7), std::size_t(511)})
        CHECK((whole(block) == reference));
}

TEST_CASE("Gains change on their sample or glide in a straight line", "[scene]")
{
    Scene scene;
    scene.clips = {tone(100.0, 2.0)};
    scene.plays = {ScenePlay{}};
    scene.changes = {{0.5, 0, SceneParameter::gain, -6.0206, 0.0}, {1.0, 0, SceneParameter::gain, 0.0, 0.4}};
    const auto changed = render(scene).front();
    scene.changes.clear();
    const auto plain = render(scene).front();
    for (std::size_t n = 0; n < plain.size(); ++n)
    {
        const double t = static_cast<double>(n) / 48000.0;
        const double gain = n < 24000 ? 1.0 : t < 1.0 ? 0.5 : std::min(1.0, 0.5 + 0.5 * (t - 1.0) / 0.4);
        REQUIRE(static_cast<double>(changed[n]) == Approx(gain * static_cast<double>(plain[n])).margin(2e-6));
    }
}

TEST_CASE("Constant-power panning keeps the power on its way across 2 to 16 actuators", "[scene]")
{
    for (int actuators : {2, 3, 8, 16})
    {
        Scene scene;
        scene.actuators = actuators;
        scene.clips = {tone(200.0, 1.0)};
        scene.plays = {ScenePlay{}};
        scene.plays[0].pan = 0.0;
        scene.changes = {{0.0, 0, SceneParameter::pan, 1.0, 1.0}};
        const auto y = render(scene);
        scene = {};
        scene.clips = {tone(200.0, 1.0)};
        scene.plays = {ScenePlay{}};
        const auto mono = render(scene).front();
        REQUIRE(y.size() == static_cast<std::size_t>(actuators));
        for (double from = 0.05; from < 0.9; from += 0.05)
        {
            double power = 0.0;
            for (const auto& channel : y)
                power += std::pow(rms(channel, from, from + 0.05), 2.0);
            CHECK(power == Approx(std::pow(rms(mono, from, from + 0.05), 2.0)).epsilon(1e-3));
        }
        if (actuators > 2)
            CHECK(rms(y.front(), 0.98, 1.0) == 0.0);
        CHECK(rms(y.back(), 0.0, 0.01) < 0.02);
    }
}

TEST_CASE("Delay panning comes later the farther the actuator", "[scene]")
{
    Scene scene;
    scene.actuators = 2;
    scene.panLaw = PanLaw::delay;
    scene.panDelay = 0.008;
    scene.duration = 1.2;
    scene.clips = {tone(50.0, 1.0)};
    scene.plays = {ScenePlay{}};
    scene.plays[0].pan = 0.25;
    const auto y = render(scene);
    // 2 ms to the first actuator, 6 ms to the second.
    const std::size_t shift = 4 * 48;
    for (std::size_t n = 4800; n < 43200; ++n)
        REQUIRE(std::abs(y[0][n] - y[1][n + shift]) < 1e-4f);
    CHECK(rms(y[1], 1.0025, 1.005) > 0.05); // the tail is played
}

TEST_CASE("Loops run on without clicks, in time, and each pass varies anew", "[scene]")
{
    Scene scene;
    scene.duration = 3.0;
    scene.clips = {tone(97.0, 0.3)};
    scene.plays = {ScenePlay{}};
    scene.plays[0].loop = 0.25;
    auto y = render(scene).front();
    CHECK(rms(y, 2.8, 2.99) == Approx(0.5 / std::sqrt(2.0)).epsilon(0.02));
    for (std::size_t n = 480; n < y.size(); ++n) // after the step at the start
        REQUIRE(std::abs(y[n] - y[n - 1]) < 0.5f * 2.0f * 3.1416f * 97.0f / 48000.0f * 1.02f);

    scene.clips[0].bands.clear();
    scene.clips[0].transients = {{0.1, 0.5, 0.5}};
    y = render(scene).front();
    for (int pass = 0; pass < 11; ++pass)
    {
        const double at = 0.1 + 0.25 * pass;
        CHECK(rms(y, at, at + 0.01) > 0.1);
        CHECK(rms(y, at + 0.03, at + 0.2) == 0.0);
    }

    scene.clips = {tone(97.0, 0.3)};
    scene.plays[0].variation = {0.6, VariationScope::band, 9};
    y = render(scene).front();
    double least = 1.0, most = 0.0;
    for (int pass = 0; pass < 11; ++pass)
    {
        const double level = rms(y, 0.25 * pass + 0.05, 0.25 * pass + 0.2);
        least = std::min(least, level);
        most = std::max(most, level);
    }
    CHECK(most > 1.5 * least);
    CHECK((render(scene).front() == y));
}

TEST_CASE("What is left out costs less than predicted, and that less than the tolerance", "[scene]")
{
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
        for (double tolerance : {-40.0, -60.0, -80.0})
        {
            CAPTURE(seed, tolerance);
            Scene scene = crowd(seed, 24, 1 + seed % 8);
            scene.actuators = 1 + static_cast<int>(seed % 3);
            if (seed % 2 == 0) // one sound many times at once adds up in amplitude
                for (std::size_t i = 12; i < 24; ++i)
                    scene.plays[i] = {"", 12, 0.1, 0.0, 0, -75.0, 0.5, 0.0, 1.0, 0, {}};
            CompileParams params;
            params.tolerance = tolerance;
            const auto plan = compilePlan(scene, nullptr, params);
            REQUIRE(plan.ok());
            ScenePlayer player(*plan);
            const double measured = errorInDecibels(test::renderChannels(player, player.actuators(), 4096),
                                                    render(scene, playEverything()));
            CHECK(measured <= plan->culledError);
            CHECK(plan->culledError <= tolerance);
            if (tolerance == -40.0)
                CHECK(plan->leftOut.size() >= 12);
        }
}

TEST_CASE("The error of leaving out keeps its bound behind limiters", "[scene]")
{
    // Full drive alone; travel and heat as well; a limit that a quarter of the drive reaches.
    const Profile wristband = test::shippedProfile("l5-wristband");
    Profile narrow = test::shippedProfile("lra-175");
    narrow.drive.maxExcursion = 0.25 * worstExcursion(*excursionParams(narrow));
    const std::vector<const Profile*> profiles = {nullptr, &wristband, &narrow};
    std::size_t limited = 0, leftOut = 0;
    for (const Profile* profile : profiles)
        for (std::uint64_t seed = 1; seed <= 10; ++seed)
            for (double tolerance : {-30.0, -40.0, -60.0})
            {
                CAPTURE(profile == nullptr ? "none" : profile->name, seed, tolerance);
                Scene scene = crowd(seed, 24, 1 + seed % 8);
                scene.gain = 3.0 * static_cast<double>(seed % 6);
                scene.actuators = 1 + static_cast<int>(seed % 2);
                for (std::size_t i = 1 + seed % 8; i < 16; ++i) // audible, but little
                    scene.plays[i].gain += 35.0;
                CompileParams params;
                params.tolerance = tolerance;
                const auto plan = compilePlan(scene, profile, params);
                REQUIRE(plan.ok());
                ScenePlayer player(*plan);
                const auto some = test::renderChannels(player, player.actuators(), 4096);
                const double measured = errorInDecibels(some, render(scene, playEverything(), profile));
                CHECK(measured <= plan->culledError);
                CHECK(plan->culledError <= tolerance);
                if (player.maxReduction() > 1.0)
                    ++limited;
                if (!plan->leftOut.empty())
                    ++leftOut;
            }
    CHECK(limited >= 45);
    CHECK(leftOut >= 60);
}

TEST_CASE("A plan names what it leaves out and why", "[scene]")
{
    Scene scene;
    scene.duration = 1.0;
    scene.clips = {tone(100.0, 1.0), tone(150.0, 1.0, 0.0), tone(200.0, 1.0)};
    scene.clips[0].bands.push_back({300.0, 300.0, 300.0, 0, {{0.0, 1e-6}}, {}});
    scene.plays.resize(5);
    scene.plays[1].clip = 1;
    scene.plays[2].clip = 2;
    scene.plays[2].gain = -90.0;
    scene.plays[3].gain = -200.0;
    scene.plays[4].start = 2.0;
    const auto plan = compilePlan(scene);
    REQUIRE(plan.ok());
    const auto reasonOf = [&](const char* where)
    {
        for (const LeftOut& item : plan->leftOut)
            if (item.where == where)
                return item.reason;
        return std::string("kept");
    };
    CHECK(reasonOf("plays[0]") == "kept");
    CHECK(reasonOf("plays[0].bands[1]") == "is too weak to be perceived");
    CHECK(reasonOf("plays[1]") == "is silent");
    CHECK(reasonOf("plays[2]") == "is too weak to be perceived");
    CHECK(reasonOf("plays[3]") == "is muted");
    CHECK(reasonOf("plays[4]") == "starts after the end of the scene");
    REQUIRE(plan->plays.size() == 1);
    CHECK(plan->plays[0].clip.bands.size() == 1);
    for (const LeftOut& item : plan->leftOut)
        if (item.where == "plays[2]")
            CHECK(item.error == Approx(-90.0).margin(1.0));
    CHECK(plan->predictedError == Approx(-90.0).margin(2.0));
    const auto everything = compilePlan(scene, nullptr, playEverything());
    REQUIRE(everything.ok());
    CHECK(everything->plays.size() == 5);
    CHECK(everything->predictedError == -std::numeric_limits<double>::infinity());
}

TEST_CASE("A scene says where it is wrong", "[scene]")
{
    const auto whereOf = [](auto&& spoil)
    {
        Scene scene;
        scene.clips = {tone(100.0, 1.0)};
        scene.plays = {ScenePlay{}};
        spoil(scene);
        const auto plan = compilePlan(scene);
        REQUIRE_FALSE(plan.ok());
        return plan.error().where;
    };
    CHECK(whereOf([](Scene& s) { s.plays[0].clip = 1; }) == "plays[0].clip");
    CHECK(whereOf([](Scene& s) { s.plays[0].loop = 1.0 / 48000.0; }) == "plays[0].loop");
    CHECK(whereOf([](Scene& s) { s.plays[0].loop = 2.0; }) == "plays[0].loop");
    CHECK(whereOf([](Scene& s) { s.plays[0].loop = 0.5; }) == "plays[0].passes");
    CHECK(whereOf([](Scene& s) { s.plays[0].gain = std::numeric_limits<double>::quiet_NaN(); }) == "plays[0].gain");
    CHECK(whereOf([](Scene& s) { s.plays[0].pan = 1.5; }) == "plays[0].pan");
    CHECK(whereOf([](Scene& s) { s.plays[0].stretch = 0.0; }) == "plays[0].stretch");
    CHECK(whereOf([](Scene& s) { s.plays.resize(10'001); }) == "plays");
    CHECK(whereOf([](Scene& s) { s.actuators = 17; }) == "actuators");
    CHECK(whereOf([](Scene& s) { s.clips[0].duration = -1.0; }) == "clips[0].duration");
    CHECK(whereOf([](Scene& s) { s.changes = {{0.5, 3, SceneParameter::gain, 0.0, 0.0}}; }) == "changes[0].play");
    CHECK(whereOf([](Scene& s) { s.changes = {{0.5, 0, SceneParameter::pan, 3.0, 0.0}}; }) == "changes[0].value");
    CHECK(whereOf(
              [](Scene& s) {
                  s.changes = {{0.5, 0, SceneParameter::pan, 0.0, 0.0}, {0.4, 0, SceneParameter::pan, 0.0, 0.0}};
              }) == "changes[1].time");
    CHECK(whereOf(
              [](Scene& s)
              {
                  s.duration = 86400.0;
                  s.plays[0].loop = 0.005;
              }) == "plays[0].loop");
}

TEST_CASE("Ten thousand plays are played in bounded memory, a few decoders at a time", "[scene]")
{
    Scene scene;
    scene.clips = {tone(100.0, 0.02)};
    for (int i = 0; i < 10'000; ++i)
    {
        ScenePlay play;
        play.start = 0.001 * i;
        scene.plays.push_back(play);
    }
    const auto plan = compilePlan(scene);
    REQUIRE(plan.ok());
    ScenePlayer player(*plan, {.sampleRate = 8000.0, .builtUntil = 0_s});
    std::vector<float> block(80);
    double sum = 0.0;
    for (std::int64_t done = 0; done < player.totalFrames(); done += 80)
    {
        player.build(Seconds(static_cast<double>(done + 80) / 8000.0));
        const std::span<float> channel(block);
        player.process(std::span(&channel, 1));
        for (float v : block)
            sum += std::abs(static_cast<double>(v));
    }
    CHECK(sum > 100.0);
    CHECK(player.maxSounding() <= 40);
}

TEST_CASE("Playing a scene makes no heap traffic, live changes included", "[scene][realtime]")
{
    Scene scene = crowd(5, 8, 8);
    scene.actuators = 2;
    scene.panLaw = PanLaw::both;
    const auto plan = compilePlan(scene);
    REQUIRE(plan.ok());
    ScenePlayer player(*plan);
    std::vector<float> left(512), right(512);
    const std::array<std::span<float>, 2> out = {left, right};
    const test::HeapGuard guard;
    for (std::size_t i = 0; i < 90; ++i)
    {
        player.process(out);
        player.setGain(i % 8, 0.01 * static_cast<double>(i));
        player.setPitchAndSpeed(i % 8, 1.0, 1.1);
    }
    CHECK(guard.traffic() == 0);
}

TEST_CASE("A live gain glides to its value and stays", "[scene]")
{
    Scene scene;
    scene.clips = {tone(100.0, 1.0)};
    scene.plays = {ScenePlay{}};
    const auto plan = compilePlan(scene);
    ScenePlayer player(*plan);
    std::vector<float> y(48000);
    const std::span<float> first(y.data(), 24000), second(y.data() + 24000, 24000);
    player.process(std::span(&first, 1));
    player.setGain(0, 0.25);
    player.process(std::span(&second, 1));
    CHECK(rms(y, 0.1, 0.5) == Approx(0.5 / std::sqrt(2.0)).epsilon(0.01));
    CHECK(rms(y, 0.51, 0.99) == Approx(0.125 / std::sqrt(2.0)).epsilon(0.02));
}
