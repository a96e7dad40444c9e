#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Measure.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/analysis/EnvelopeFollower.h>

#include <cmath>
#include <span>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{

Seconds milliseconds(const nlohmann::json& value)
{
    return Seconds(value.get<double>() / 1000.0);
}

DecayDefinition decayOf(const nlohmann::json& entry)
{
    return entry["kind"] == "99" ? DecayDefinition::percent99 : DecayDefinition::percent63;
}

/// Largest deviation of the follower's envelope (through tick, in double) from the reference.
double deviation(const nlohmann::json& data, const nlohmann::json& entry, const EnvelopeFollowerParams& params)
{
    EnvelopeFollower follower;
    follower.setParams(params);
    follower.prepare({data["fs"], 1});
    const auto& x = data["inputs"][entry["signal"].get<std::string>()];
    double worst = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
        worst = std::max(worst, std::abs(follower.tick(x[i]) - entry["y"][i].get<double>()));
    return worst;
}

EnvelopeFollowerParams paramsOf(const nlohmann::json& entry, RisingSlope slope)
{
    return {milliseconds(entry["attack_ms"]), milliseconds(entry["hold_ms"]), milliseconds(entry["release_ms"]),
            decayOf(entry), slope};
}

} // namespace

TEST_CASE("Frames and coefficients of a time equal the reference", "[analysis][golden]")
{
    const auto data = golden("coefficients");
    for (const auto& entry : data["cases"])
    {
        const Seconds time = milliseconds(entry["t_ms"]);
        const double fs = entry["fs"];
        CAPTURE(time.value, fs);
        const std::size_t frames = roundedFrames(time, fs);
        CHECK(frames == entry["N"].get<std::size_t>());
        const double tolerance = data["tol"];
        CHECK(std::abs(decayCoefficient(static_cast<double>(frames), DecayDefinition::percent99) -
                       entry["c99"].get<double>()) <= tolerance);
        CHECK(std::abs(decayCoefficient(static_cast<double>(frames), DecayDefinition::percent63) -
                       entry["c63"].get<double>()) <= tolerance);
    }
}

TEST_CASE("Half a frame rounds up although milliseconds are not exact in binary", "[analysis]")
{
    for (const double fs : {1000.0, 8000.0, 44100.0, 48000.0, 96000.0})
        for (int n = 0; n < 3000; ++n)
        {
            const double halfFrames = static_cast<double>(n) + 0.5;
            CHECK(roundedFrames(Seconds(halfFrames / fs), fs) == static_cast<std::size_t>(n) + 1);
        }
    CHECK(roundedFrames(Seconds(-1.0), 48000.0) == 0);
    CHECK(roundedFrames(Seconds(std::numeric_limits<double>::quiet_NaN()), 48000.0) == 0);
    CHECK(roundedFrames(Seconds(std::numeric_limits<double>::infinity()), 48000.0) == std::size_t{1} << 53);
}

TEST_CASE("The envelope follower equals the reference in every reading", "[analysis][golden]")
{
    const auto data = golden("envelope");
    const double tolerance = data["tol"];
    for (const auto& entry : data["cases"])
        CHECK(deviation(data, entry, paramsOf(entry, RisingSlope::level)) <= tolerance);
    for (const auto& entry : data["plateau"])
        CHECK(deviation(data, entry, paramsOf(entry, RisingSlope::level)) <= tolerance);
    for (const auto& entry : data["alt_strict"])
        CHECK(deviation(data, entry, paramsOf(entry, RisingSlope::strict)) <= tolerance);
    for (const auto& entry : data["alt_dx"])
        CHECK(deviation(data, entry, paramsOf(entry, RisingSlope::derivative)) <= tolerance);
    for (const auto& entry : data["adaptive"])
    {
        EnvelopeFollowerParams params{milliseconds(entry["attack_max_ms"]), milliseconds(entry["hold_ms"]),
                                      milliseconds(entry["release_max_ms"]), decayOf(entry)};
        params.crestAdaptive = true;
        params.crestMemory = milliseconds(entry["forget_ms"]);
        CHECK(deviation(data, entry, params) <= tolerance);
    }
}

TEST_CASE("The readings of the rising slope differ where they should", "[analysis]")
{
    const auto data = golden("envelope");
    const auto& strict = data["alt_strict"][0];
    CHECK(deviation(data, strict, paramsOf(strict, RisingSlope::level)) > 0.01);
    const auto& derivative = data["alt_dx"][1];
    CHECK(deviation(data, derivative, paramsOf(derivative, RisingSlope::level)) > 0.01);
}

TEST_CASE("The envelope of a step rises 99 or 63 % in the attack, holds, and falls as much in the release",
          "[analysis]")
{
    for (const double fs : {8000.0, 48000.0, 384000.0})
        for (const auto& [decay, done] :
             {std::pair{DecayDefinition::percent99, 0.99}, std::pair{DecayDefinition::percent63, 1.0 - std::exp(-1.0)}})
        {
            EnvelopeFollower follower;
            follower.setParams({5_ms, 10_ms, 20_ms, decay});
            follower.prepare({fs, 1});
            const auto frames = [fs](double ms)
            {
                return static_cast<std::size_t>(ms * fs / 1000.0);
            };
            double y = 0.0;
            for (std::size_t i = 0; i < frames(5.0); ++i)
                y = follower.tick(-0.5);
            CHECK(y == Approx(0.5 * done).epsilon(1e-9));
            for (std::size_t i = 0; i < frames(500.0); ++i)
                y = follower.tick(0.5);
            CHECK(y == Approx(0.5).epsilon(1e-9));
            for (std::size_t i = 0; i < frames(10.0); ++i)
                y = follower.tick(0.0);
            CHECK(y == Approx(0.5).epsilon(1e-9));
            for (std::size_t i = 0; i < frames(20.0); ++i)
                y = follower.tick(0.0);
            CHECK(y == Approx(0.5 * (1.0 - done)).epsilon(1e-9));
        }
}

TEST_CASE("Crest-adaptive times are the longest ones for a steady sine and shorter for clicks", "[analysis]")
{
    const double fs = 8000.0;
    EnvelopeFollowerParams params{80_ms, 0_s, 1_s, DecayDefinition::percent63};
    params.crestAdaptive = true;
    const auto halfLife = [&](const std::vector<float>& sound)
    {
        EnvelopeFollower follower;
        follower.setParams(params);
        follower.prepare({fs, sound.size()});
        std::vector<float> y(sound.size());
        follower.process(sound, y);
        const float end = y.back();
        std::size_t frames = 0;
        while (follower.tick(0.0) > 0.5 * static_cast<double>(end))
            ++frames;
        return static_cast<double>(frames) / fs;
    };
    std::vector<float> clicks(16000, 0.0f);
    for (std::size_t i = 0; i < clicks.size(); i += 400)
        clicks[i] = 1.0f;
    const double steady = halfLife(sine(16000, 200.0, fs));
    CHECK(steady < 1.0);
    CHECK(halfLife(clicks) < 0.5 * steady);
}

TEST_CASE("EnvelopeFollower keeps the contract of blocks", "[analysis][contract]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    EnvelopeFollowerParams adaptive{80_ms, 0_s, 1_s, DecayDefinition::percent99};
    adaptive.crestAdaptive = true;
    const EnvelopeFollowerParams instant{0_s, 0_s, 0_s};
    const EnvelopeFollowerParams bad{Seconds(nan), Seconds(nan), Seconds(nan)};
    EnvelopeFollowerParams endless{Seconds(inf), Seconds(inf), Seconds(inf)};
    checkBlockContract<EnvelopeFollower>({}, {.bound = 1.0, .delay = MeasuredDelay::firstFrame});
    checkBlockContract<EnvelopeFollower>({1_ms, 0_s, 10_ms, DecayDefinition::percent63, RisingSlope::derivative},
                                         {.bound = 1.0});
    checkBlockContract<EnvelopeFollower>(adaptive, {.bound = 1.0});
    checkBlockContract<EnvelopeFollower>(instant, {.bound = 1.0, .delay = MeasuredDelay::firstFrame});
    checkBlockContract<EnvelopeFollower>(bad, {.bound = 1.0});
    checkBlockContract<EnvelopeFollower>(endless, {.bound = 1.0});
    checkModulation<EnvelopeFollower>({adaptive, instant, bad, endless, {}}, 1.0);
    endless.crestAdaptive = true;
    endless.crestMemory = Seconds(nan);
    checkBlockContract<EnvelopeFollower>(endless, {.bound = 1.0});
    checkSilenceIsCheap<EnvelopeFollower>({});
    checkSilenceIsCheap<EnvelopeFollower>({}, 480000);
    checkSilenceIsCheap<EnvelopeFollower>(adaptive);
}

TEST_CASE("Envelopes of bursts are what they were, with steady and with adaptive times", "[analysis]")
{
    const auto hiss = noise(1500, 2);
    for (const bool adaptive : {false, true})
        for (const auto slope : {RisingSlope::level, RisingSlope::strict, RisingSlope::derivative})
            for (const auto decay : {DecayDefinition::percent99, DecayDefinition::percent63})
            {
                EnvelopeFollower follower;
                follower.setParams({.attack = Seconds(0.004),
                                    .hold = Seconds(0.006),
                                    .release = Seconds(0.030),
                                    .decay = decay,
                                    .slope = slope,
                                    .crestAdaptive = adaptive,
                                    .crestMemory = Seconds(0.05)});
                follower.prepare({8000.0, 1500});
                std::vector<double> envelope;
                for (std::size_t n = 0; n < hiss.size(); ++n)
                    envelope.push_back(follower.tick((n / 300) % 2 == 0
                                                         ? static_cast<double>(hiss[n])
                                                         : 0.01 * std::sin(0.1 * static_cast<double>(n))));
                const std::string name = "analysis/envelope of bursts, slope " +
                                         std::to_string(static_cast<int>(slope)) + ", decay " +
                                         std::to_string(static_cast<int>(decay)) + (adaptive ? ", adaptive" : "");
                checkPinned(name, envelope);
                checkPinned(name + ", start", std::span<const double>(envelope).first(20));
            }
    const EnvelopeFollowerParams usual;
    CHECK(test::asNumbers(usual.attack.value, usual.hold.value, usual.release.value, usual.crestMemory.value,
                          usual.crestAdaptive) == test::Numbers{0.001, 0.010, 0.020, 0.200, false});
    CHECK(EnvelopeFollowerCoefficients{} == EnvelopeFollowerCoefficients{0.0, 0.0, 0, 0.0, 0.0, 0.0});
    const auto longest =
        designEnvelopeFollower({.attack = Seconds(1e9), .hold = Seconds(1e9), .release = Seconds(-1.0)}, 1000.0);
    CHECK(longest.attack == std::pow(0.01, 1.0 / 3.6e6));
    CHECK(longest.holdFrames == 3600000);
    CHECK(longest.release == 0.0);
    CHECK(longest.longestAttackFrames == 3.6e6);
    CHECK(longest.longestReleaseFrames == 0.0);
    CHECK(longest.crestMemory == std::exp(-1.0 / 200.0));
    CHECK(roundedFrames(Seconds(-1.0), 48000.0) == 0);
    CHECK(roundedFrames(Seconds(std::nan("")), 48000.0) == 0);
    CHECK(roundedFrames(Seconds(1e300), 48000.0) == std::size_t(1) << 53);
    CHECK(decayCoefficient(0.0, DecayDefinition::percent63) == 0.0);
    CHECK(decayCoefficient(-3.0, DecayDefinition::percent99) == 0.0);
    CHECK(decayCoefficient(2.0, DecayDefinition::percent99) == Approx(0.1));
    CHECK(decayCoefficient(2.0, DecayDefinition::percent63) == Approx(std::exp(-0.5)));
}

TEST_CASE("Adaptive envelopes of silence are cheap", "[analysis]")
{
    checkSilenceIsCheap<EnvelopeFollower>({.crestAdaptive = true, .crestMemory = Seconds(0.02)});
}
