#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Interleave.h"
#include "support/Measure.h"

#include <pacini/analysis/MonoMix.h>

using namespace pacini;
using namespace pacini::test;

namespace
{

std::vector<float> times(std::vector<float> x, float gain)
{
    for (float& v : x)
        v *= gain;
    return x;
}

} // namespace

TEST_CASE("One channel and equal channels stay as they are", "[analysis]")
{
    const auto x = noise(1000, 1);
    CHECK((monoMix(x, 1) == x));
    CHECK((monoMix(interleave({x, x}), 2) == x));
    CHECK((monoMix(interleave({x, x, x, x}), 4) == x));
    CHECK(monoMix({}, 2).empty());
}

TEST_CASE("Unrelated channels give their mean", "[analysis]")
{
    const auto a = sine(4800, 200.0, 48000.0);
    const auto b = sine(4800, 300.0, 48000.0);
    const auto mono = monoMix(interleave({a, b}), 2);
    for (std::size_t i = 0; i < mono.size(); ++i)
    {
        const float plus = 0.5f * (a[i] + b[i]);
        const float minus = 0.5f * (a[i] - b[i]);
        REQUIRE((std::abs(mono[i] - plus) < 1e-6f || std::abs(mono[i] - minus) < 1e-6f));
    }
    CHECK(rms(mono) == Approx(0.5).epsilon(1e-4));
}

TEST_CASE("Channels in antiphase do not cancel in any order", "[analysis]")
{
    const auto x = noise(1000, 2);
    const auto y = times(x, -1.0f);
    const auto nothing = times(x, 0.0f);
    CHECK((monoMix(interleave({x, y}), 2) == x));
    CHECK((monoMix(interleave({x, x, y, y}), 4) == x));
    CHECK((monoMix(interleave({x, y, y, x}), 4) == x));
    CHECK(rms(monoMix(interleave({nothing, x, y}), 3)) == Approx(2.0 / 3.0 * rms(x)).epsilon(1e-6));
    // With other polarities for half of the power, and with something of its own in each channel.
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
        Random random(seed);
        std::vector<std::vector<float>> channels;
        double power = 0.0;
        for (std::uint64_t c = 0; c < 5; ++c)
        {
            auto channel = times(noise(1000, 100 * seed + c), 0.3f);
            const auto gain = static_cast<float>(random.uniform(-1.0, 1.0));
            for (std::size_t i = 0; i < channel.size(); ++i)
                channel[i] += gain * x[i];
            power += rms(channel) * rms(channel);
            channels.push_back(channel);
        }
        CHECK(rms(monoMix(interleave(channels), 5)) >= std::sqrt(power) / 5.0 * (1.0 - 1e-6));
    }
}
