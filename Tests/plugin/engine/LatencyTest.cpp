// The latency that a host is told, and when.

#include "plugin/engine/Rig.h"

using namespace pacini;
using namespace pacini::test;

TEST_CASE("A host that asks before it has told its rate reads the latency of 48 kHz")
{
    const plugin::PluginProcessor fresh;
    const Rig rig;
    CHECK(fresh.getLatencySamples() == rig.plugin.getLatencySamples());
    CHECK(fresh.getLatencySamples() == 62);
}

TEST_CASE("A host that loads at 44.1 kHz and plays at 48 kHz has the right latency from its first block")
{
    Rig rig({.rate = 44100.0});
    const int atLoading = rig.plugin.getLatencySamples();
    rig.plugin.setRateAndBufferSizeDetails(48000.0, 512);
    rig.plugin.prepareToPlay(48000.0, 512);
    CHECK(rig.plugin.getLatencySamples() == atLoading);
    const Channels in = liveSounds(2, 4800, 1);
    const auto out = rig.run(in);
    CHECK(out.main[0] == delayed(in[0], static_cast<std::size_t>(atLoading)));
}

TEST_CASE("The drive is as late as the sound at every rate, also where it waits for the common latency")
{
    for (const double rate : {44100.0, 47000.0, 48000.0, 88200.0, 96000.0})
    {
        Rig rig({.rate = rate});
        // A burst that every band of touch has: the actuator's drive follows it.
        const auto frames = static_cast<std::size_t>(rate);
        Channels in(2, std::vector<float>(frames));
        for (std::size_t i = 0; i < frames; ++i)
        {
            const double t = static_cast<double>(i) / rate - 0.5;
            const double window = std::exp(-0.5 * t * t / (0.02 * 0.02));
            in[0][i] = in[1][i] = static_cast<float>(0.3 * window * std::sin(2.0 * std::numbers::pi * 120.0 * t));
        }
        const auto out = rig.run(in);
        const auto latency = static_cast<std::size_t>(rig.plugin.getLatencySamples());
        const auto likeness = [&](std::size_t lag)
        {
            double sum = 0.0;
            for (std::size_t i = lag; i < frames; ++i)
                sum += static_cast<double>(out.haptic[0][i]) * static_cast<double>(in[0][i - lag]);
            return sum;
        };
        std::size_t best = 0;
        for (std::size_t lag = 1; lag < 4 * latency; ++lag)
            if (likeness(lag) > likeness(best))
                best = lag;
        INFO(rate << " Hz, latency " << latency << ", likest at " << best);
        CHECK(std::abs(static_cast<double>(best) - static_cast<double>(latency)) < 0.0005 * rate);
    }
}
