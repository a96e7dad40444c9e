#include "support/Catch.h"

#include <pacini/realtime/HighBandVoice.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
constexpr double voiceRate = 6000.0;

/// What the voice plays of a tone of `amplitude`, as a sinusoid of a quarter of the rate: every second frame is its
/// amplitude.
std::vector<double> played(HighBandVoice& voice, double f, double amplitude, double gain, std::size_t hops)
{
    std::vector<double> sounds;
    for (std::size_t hop = 0; hop < hops; ++hop)
    {
        std::vector<double> in(controlHop), out(controlHop, 0.0);
        for (std::size_t i = 0; i < controlHop; ++i)
            in[i] = amplitude *
                    std::sin(2.0 * std::numbers::pi * f * static_cast<double>(hop * controlHop + i) / voiceRate + 0.3);
        voice.aim(gain, 1.0, 0.25);
        voice.process(in, out, 0);
        for (std::size_t i = 0; i < controlHop; i += 2)
            sounds.push_back(std::max(std::abs(out[i]), std::abs(out[i + 1])));
        voice.flush();
    }
    return sounds;
}

/// Power of what lies above and below the border of second-order Butterworth filters.
struct Parts
{
    explicit Parts(double f)
    {
        const double r = std::tan(std::numbers::pi * f / voiceRate) / std::tan(std::numbers::pi * 320.0 / voiceRate);
        below = 1.0 / (1.0 + r * r * r * r);
        above = 1.0 - below;
    }
    double below, above;
};
} // namespace

TEST_CASE("the high-band voice is as strong as what lies above the border, less what is felt below it", "[realtime]")
{
    for (const double f : {150.0, 300.0, 375.0, 750.0, 1500.0})
        for (const double gain : {0.7, 1.0, 3.0})
        {
            CAPTURE(f, gain);
            HighBandVoice voice;
            voice.design(voiceRate);
            voice.jump(gain);
            const auto sounds = played(voice, f, 0.5, gain, 400);
            double mean = 0.0;
            for (std::size_t n = 800; n < 1600; ++n)
                mean += sounds[n] / 800.0;
            const Parts parts(f);
            const double expected = 0.5 * std::sqrt(std::max(0.0, gain * gain * parts.above - parts.below));
            CHECK(mean == Approx(expected).epsilon(0.01).margin(1e-3));
        }
}

TEST_CASE("the high-band voice follows within 4 ms, and is silent soon after its sound", "[realtime]")
{
    HighBandVoice voice;
    voice.design(voiceRate);
    CHECK(voice.silent());
    voice.jump(1.0);
    // 1.5 kHz: every hop has two whole periods, so that nothing ripples.
    const auto sounds = played(voice, 1500.0, 0.5, 1.0, 60);
    const double whole = sounds.back();
    // The power goes 1 - 1 / e of the way in 4 ms, two hops and a half late: it is heard, and played along a curve.
    const auto at = [&](double seconds)
    {
        return sounds[static_cast<std::size_t>(std::lround(seconds * voiceRate / 2.0)) - 1] / whole;
    };
    const double hop = static_cast<double>(controlHop) / voiceRate;
    CHECK(at(hop) == 0.0);
    for (const double k : {4.0, 6.0, 8.0}) // before, the filters still begin
        CHECK(at((k + 1.5) * hop) == Approx(std::sqrt(1.0 - std::exp(-k * hop / 0.004))).epsilon(0.03));
    (void)played(voice, 1500.0, 0.0, 1.0, 200);
    (void)played(voice, 1500.0, 0.0, 0.0, 40);
    CHECK(voice.silent());
    voice.reset();
    CHECK(played(voice, 1500.0, 0.5, 1.0, 60) == sounds);
}
