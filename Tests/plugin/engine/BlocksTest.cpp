// How hosts call: any block, any rate, any sample.

#include "plugin/engine/Rig.h"

#include <limits>

using namespace pacini;
using namespace pacini::test;
using plugin::ParameterId;

TEST_CASE("The output does not depend on the size of blocks, be they larger than announced or empty")
{
    const auto in = liveSounds(2, 70000, 5);
    Rig reference;
    const auto expected = reference.run(in, {in[0]});
    for (const auto& sizes : std::vector<std::vector<int>>{{1}, {64}, {127}, {1009, 3, 1}, {65536}})
    {
        CAPTURE(sizes);
        Rig rig({}, 32);
        CHECK(rig.run(in, {in[0]}, sizes) == expected);
    }
    Rig rig;
    juce::AudioBuffer<float> nothing(3, 0);
    juce::MidiBuffer midi;
    CHECK(rig.run(in, {in[0]}, {512}, [&](std::size_t) { rig.plugin.processBlock(nothing, midi); }) == expected);
}

TEST_CASE("Every rate from 8 to 768 kHz is played, also when it changes without release")
{
    Rig rig;
    const auto in = liveSounds(2, 20000, 5);
    for (const double rate : {8000.0, 11025.0, 44100.0, 96000.0, 384000.0, 768000.0, 48000.0})
    {
        CAPTURE(rate);
        rig.plugin.setRateAndBufferSizeDetails(rate, 512);
        rig.plugin.prepareToPlay(rate, 512);
        const auto out = rig.run(in);
        CHECK(out.main[1] == delayed(in[1], static_cast<std::size_t>(rig.plugin.getLatencySamples())));
        CHECK(energy(out.haptic[0]) > 0.0);
        Rig fresh({rate});
        CHECK(fresh.run(in) == out);
    }
}

TEST_CASE("Reset forgets the sound")
{
    const auto in = liveSounds(2, 20000, 5);
    Rig rig;
    const auto expected = rig.run(in);
    rig.plugin.reset();
    CHECK(rig.run(in) == expected);
}

TEST_CASE("NaN, infinities and denormals never reach the actuator")
{
    auto in = liveSounds(2, 20000, 5);
    in[0][500] = std::numeric_limits<float>::quiet_NaN();
    in[1][501] = std::numeric_limits<float>::infinity();
    in[0][502] = -std::numeric_limits<float>::max();
    in[1][503] = std::numeric_limits<float>::denorm_min();
    for (const double mode : {0.0, 1.0})
    {
        Rig rig;
        rig.set(ParameterId::outputMode, mode);
        const auto out = rig.run(in, {in[0]});
        for (const float y : out.haptic[0])
            REQUIRE(std::abs(y) <= 1.0f);
        double late = 0.0;
        for (std::size_t i = 10000; i < out.haptic[0].size(); ++i)
            late += std::abs(static_cast<double>(out.haptic[0][i]));
        CHECK(late > 0.0);
        CHECK(rig.plugin.capture(1.0).samples.size() == 20000);
        for (const float x : rig.plugin.capture(1.0).samples)
            REQUIRE(std::isfinite(x));
    }
}

TEST_CASE("Offline rendering gives the same samples as real time")
{
    const auto in = liveSounds(2, 48000, 5);
    const auto render = [&](bool offline)
    {
        Rig rig;
        rig.plugin.setNonRealtime(offline);
        rig.set(ParameterId::profile, 1.0);
        rig.plugin.prepareToPlay(48000.0, 512);
        return rig.run(in, {}, {offline ? 4096 : 128},
                       [&](std::size_t block)
                       { rig.set(ParameterId::intensity, block * (offline ? 4096 : 128) >= 24576 ? -12.0 : 0.0); });
    };
    CHECK(render(true) == render(false));
}

TEST_CASE("Offline, another actuator counts from the block on that brings it")
{
    const auto in = liveSounds(2, 48000, 5);
    const auto render = [&]
    {
        Rig rig;
        rig.plugin.setNonRealtime(true);
        return rig.run(in, {}, {512},
                       [&](std::size_t block) { rig.set(ParameterId::profile, block < 20 ? 0.0 : 3.0); });
    };
    const auto once = render();
    CHECK(once == render());
    CHECK_FALSE(once == Rig().run(in));
}
