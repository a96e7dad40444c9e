#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/actuator/OutputFilter.h>
#include <pacini/foundation/Random.h>
#include <pacini/synthesis/PlayEnergy.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
/// A clip with everything that carries energy.
Clip energeticClip()
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {{80.0, 100.0, 120.0, 0, {{0.0, 0.2}, {0.4, 0.8}, {0.9, 0.1}}, {{0.0, 70.0}, {0.5, 130.0}}},
                  {250.0, 300.0, 400.0, 1, {{0.1, 0.5}}, {}},
                  {450.0, 500.0, 600.0, 2, {{0.0, 0.0}, {1.0, 0.0}}, {{0.0, 480.0}}}};
    clip.noise = {{150.0, 250.0, {{0.0, 0.1}, {1.0, 0.3}}}, {0.2, 1.0, {{0.0, 0.02}}}, {5.0, 9.0, {}}};
    clip.transients = {{0.05, 0.9, 0.5}, {0.3, 0.6, 1.0}, {0.7, 0.5, 0.0}, {0.99, 1.0, 0.2}};
    return clip;
}

BiquadCascadeCoefficients someEqualizer(double fs)
{
    EqualizerSections sections;
    EqualizerSection peak;
    peak.frequency = 180.0;
    peak.gain = 9.0;
    peak.q = 2.0;
    sections.pushBack(peak);
    peak.frequency = 60.0;
    peak.gain = -12.0;
    sections.pushBack(peak);
    return designOutputFilter({sections, {}}, fs);
}

PlayTimeline energyTimeline()
{
    PlayTimeline timeline;
    timeline.gains = {{{0.0, 1.0}, {0.6, 0.5}, {0.6, 2.0}}, {{0.0, 0.0}, {0.5, 0.25}}};
    return timeline;
}

void pinEnergy(const std::string& name, const PlayEnergy& energy)
{
    std::vector<double> all = {energy.least, energy.most, energy.bandErrors, energy.levelled ? 1.0 : 0.0,
                               energy.gains.events};
    for (const auto* list : {&energy.bands, &energy.noise, &energy.gains.bands, &energy.gains.noise})
        all.insert(all.end(), list->begin(), list->end());
    REQUIRE(all.size() <= 24);
    checkPinned("synthesis/energy of " + name, all);
}
} // namespace

TEST_CASE("Nothing is known of an energy before it is worked out", "[scene]")
{
    const PartGains gains;
    CHECK(gains.events == 1.0);
    CHECK(gains.largest() == 0.0);
    CHECK(PartGains{{0.5, 2.0, 1.0}, {1.5}, 9.0}.largest() == 2.0);
    CHECK(PartGains{{0.5}, {1.5, 0.1}, 9.0}.largest() == 1.5);
    const PlayEnergy energy;
    CHECK(energy.least == 0.0);
    CHECK(energy.most == 0.0);
    CHECK_FALSE(energy.levelled);
    CHECK(energy.bandErrors == 1.0);
    CHECK(PlayEnergy::fastBeats == 1.3);
    detail::PowerRange range;
    CHECK(range.most == 0.0);
    CHECK(std::isinf(range.least));
    range.include(2.0);
    range.include(0.5);
    range.include(1.0);
    CHECK(range.least == 0.5);
    CHECK(range.most == 2.0);
}

TEST_CASE("The energy of a product of two curves is its integral", "[scene]")
{
    CHECK(detail::energyOfProduct({{0.0, 2.0}}, {{0.0, 3.0}}, 1.0, 1.5) == Approx(18.0));
    CHECK(detail::energyOfProduct({{0.0, 0.0}, {1.0, 1.0}}, {{0.0, 0.0}, {1.0, 1.0}}, 0.0, 1.0) == Approx(0.2));
    CHECK(detail::energyOfProduct({}, {{0.0, 3.0}}, 0.0, 1.0) == 0.0);
    CHECK(detail::energyOfProduct({{0.0, 3.0}}, {}, 0.0, 1.0) == 0.0);
    CHECK(detail::energyOfProduct({{0.0, 3.0}}, {{0.0, 3.0}}, 1.0, 1.0) == 0.0);
    CHECK(detail::energyOfProduct({{0.0, 3.0}}, {{0.0, 3.0}}, 1.0, 0.0) == 0.0);
    CHECK(detail::energyOfProduct({{0.0, 3.0}}, {{0.0, 3.0}}, 0.0, std::numeric_limits<double>::quiet_NaN()) == 0.0);
    Random random(5);
    for (int run = 0; run < 40; ++run)
    {
        Curve curves[2];
        for (Curve& curve : curves)
        {
            double time = random.uniform(-0.2, 0.5);
            for (int k = 1 + run % 4; k >= 0; --k, time += k % 3 == 0 ? 0.0 : random.uniform(0.0, 0.5))
                curve.push_back({time, random.uniform(-1.0, 2.0)});
        }
        const double from = random.uniform(0.0, 0.4), to = from + random.uniform(0.1, 1.5);
        double wanted = 0.0;
        constexpr int steps = 20000;
        for (int i = 0; i < steps; ++i)
        {
            const double time = from + (to - from) * (i + 0.5) / steps;
            const double v = valueAt(curves[0], time) * valueAt(curves[1], time);
            wanted += v * v * (to - from) / steps;
        }
        CHECK(detail::energyOfProduct(curves[0], curves[1], from, to) == Approx(wanted).epsilon(1e-3).margin(1e-4));
    }
}

TEST_CASE("A curve in the scene's time goes by the clock of its play", "[scene]")
{
    PlayClock clock(2);
    clock.change(0.0, 0.5, 1.0);
    clock.change(1.0, 2.0, 1.0);
    CHECK(detail::inSceneTime({{0.0, 1.0}, {0.5, 2.0}, {1.5, 3.0}}, clock, 10.0) ==
          Curve{{10.0, 1.0}, {11.0, 2.0}, {11.5, 3.0}});
    CHECK(detail::inSceneTime({}, clock, 10.0).empty());
}

TEST_CASE("The power of an equaliser is looked at nine times from end to end, in octaves", "[scene]")
{
    const double fs = 48000.0;
    const auto equalizer = someEqualizer(fs);
    for (const auto& [low, high] : {std::pair{100.0, 300.0}, {20.0, 20.0}, {0.01, 8.0}, {20000.0, 90000.0}})
    {
        const auto range = detail::equalizerPower(equalizer, low, high, fs);
        double least = 1e9, most = 0.0;
        for (int i = 0; i <= 8; ++i)
        {
            const double f = std::exp(std::log(low) + (std::log(high) - std::log(low)) * i / 8.0);
            const double power = std::norm(equalizer.response(Hertz(std::min(std::max(f, 0.5), 23520.0)), fs));
            least = std::min(least, power);
            most = std::max(most, power);
        }
        CHECK(range.least == Approx(least));
        CHECK(range.most == Approx(most));
    }
}

TEST_CASE("A sinusoid carries half its squared amplitude, noise its squared level, for as long as it sounds", "[scene]")
{
    const auto flat = designOutputFilter({}, 48000.0);
    PlayTimeline plain;
    plain.gains = {{{0.0, 1.0}}};
    Clip clip;
    clip.duration = 2.0;
    clip.bands = {{80.0, 100.0, 120.0, 0, {{0.0, 0.4}}, {}}};
    DecoderParams params;
    params.gain = 3.0;
    auto energy = playEnergy(clip, params, plain, 0.5, 10.0, flat);
    CHECK(energy.least == Approx(0.5 * 0.16 * 9.0 * 2.0));
    CHECK(energy.most == Approx(energy.least));
    REQUIRE(energy.bands.size() == 1);
    CHECK(energy.bands[0] == Approx(energy.least));
    CHECK(energy.gains.bands == std::vector<double>{1.0});
    CHECK_FALSE(energy.levelled);
    CHECK(energy.bandErrors == 1.0);
    // As far as the scene goes, for the stretch of the clip, towards all actuators.
    CHECK(playEnergy(clip, params, plain, 0.5, 1.5, flat).least == Approx(0.5 * 0.16 * 9.0));
    params.stretch = 2.0;
    CHECK(playEnergy(clip, params, plain, 0.5, 10.0, flat).least == Approx(0.5 * 0.16 * 9.0 * 4.0));
    params.stretch = 1.0;
    plain.gains = {{{0.0, 0.5}}, {{0.0, 2.0}}};
    CHECK(playEnergy(clip, params, plain, 0.5, 10.0, flat).least == Approx(0.5 * 0.16 * 9.0 * 2.0 * 4.25));
    plain.gains = {{{0.0, 1.0}}};
    clip.noise = {{100.0, 200.0, {{0.0, 0.3}}}};
    energy = playEnergy(clip, params, plain, 0.5, 10.0, flat);
    CHECK(energy.least == Approx((0.08 + 0.09) * 18.0));
    CHECK(energy.most == Approx((0.08 + 0.09) * 18.0));
    CHECK(energy.noise[0] == Approx(0.09 * 18.0));
    // Levelled to an envelope, that tells; a band that is missing is made up for.
    clip.envelope = {{0.0, 0.2}};
    energy = playEnergy(clip, params, plain, 0.5, 10.0, flat);
    CHECK(energy.levelled);
    CHECK(energy.least == Approx(0.02 * 18.0));
    CHECK(energy.most == Approx(0.02 * 18.0 * 1.3));
    CHECK(energy.bandErrors == 4.0);
    CHECK(energy.bands[0] == Approx(4.0 * 0.08 * 18.0));
    CHECK(energy.noise[0] == Approx(4.0 * 0.09 * 18.0));
    clip.envelope = {{0.0, 1.0}};
    energy = playEnergy(clip, params, plain, 0.5, 10.0, flat);
    CHECK(energy.bandErrors == Approx(4.0 * 0.5 / 0.17));
    params.followEnvelope = false;
    CHECK_FALSE(playEnergy(clip, params, plain, 0.5, 10.0, flat).levelled);
    // However weak it is; and what is silent has no say in the gains of an equaliser.
    Clip weak;
    weak.duration = 2.0;
    weak.bands = {{80.0, 100.0, 120.0, 0, {{0.0, 0.04}}, {}}};
    weak.envelope = {{0.0, 0.02}};
    CHECK(playEnergy(weak, {}, plain, 0.0, 10.0, flat).least == Approx(0.5 * 0.0004 * 2.0));
    weak.envelope.clear();
    weak.noise = {{150.0, 250.0, {{0.0, 0.0}}}};
    const auto equalizer = someEqualizer(48000.0);
    const double at100 = std::norm(equalizer.response(Hertz(100.0), 48000.0));
    CHECK(playEnergy(weak, {}, plain, 0.0, 10.0, equalizer).most == Approx(0.5 * 0.0016 * 2.0 * at100));
    CHECK(playEnergy(weak, {}, plain, 0.0, 10.0, equalizer).least == Approx(0.5 * 0.0016 * 2.0 * at100));
}

TEST_CASE("An event carries at most 3 / 16 of its square for 20 ms and at least for 4 ms where it is not masked",
          "[scene]")
{
    const auto flat = designOutputFilter({}, 48000.0);
    PlayTimeline plain;
    plain.gains = {{{0.0, 1.0}}, {{0.0, 2.0}}};
    Clip clip;
    clip.duration = 1.0;
    clip.transients = {{0.25, 0.4, 0.5}, {0.75, 0.8, 0.5}};
    DecoderParams params;
    params.gain = 0.5;
    const double unit = 3.0 / 16.0 * 5.0 * 0.25;
    const auto energyUntil = [&](double duration)
    {
        return playEnergy(clip, params, plain, 1.0, duration, flat);
    };
    CHECK(energyUntil(5.0).most == Approx(unit * 0.8 * 0.02));
    CHECK(energyUntil(5.0).least == Approx(unit * 0.8 * 0.004));
    CHECK(energyUntil(1.76).most == Approx(unit * 0.8 * 0.02));
    CHECK(energyUntil(1.75).most == Approx(unit * 0.16 * 0.02)); // what begins at the end does not sound
    CHECK(energyUntil(1.2).most == 0.0);
    params.pulses = {TransientShape::sine, 50.0, 2.0};
    CHECK(energyUntil(5.0).most == Approx(unit * 0.8 * 0.2));
    params.pulses = {};
    clip.envelope = {{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.1}, {1.0, 0.1}};
    CHECK(energyUntil(5.0).least == Approx(unit * 0.16 * 0.004));
    CHECK(energyUntil(5.0).most == Approx(unit * 0.8 * 0.02));
    params.followEnvelope = false;
    CHECK(energyUntil(5.0).least == Approx(unit * 0.8 * 0.004));
}

TEST_CASE("Energies of clips with everything, behind an equaliser, are what they were", "[scene]")
{
    const double fs = 48000.0;
    const auto equalizer = someEqualizer(fs);
    const Clip clip = energeticClip();
    DecoderParams params;
    params.gain = 1.5;
    PlayTimeline timeline = energyTimeline();
    pinEnergy("a clip with everything", playEnergy(clip, params, timeline, 0.2, 3.0, equalizer));
    params.carriers = CarrierMode::fixed;
    params.transposition = 7.0;
    pinEnergy("fixed carriers, transposed", playEnergy(clip, params, timeline, 0.2, 0.9, equalizer));
    params.carriers = CarrierMode::pitch;
    timeline.changes = {{0.1, -12.0, 0.5}, {0.4, 12.0, 2.0}};
    pinEnergy("changing pitch and speed", playEnergy(clip, params, timeline, 0.2, 3.0, equalizer));
    Clip levelled = clip;
    levelled.envelope = {{0.0, 0.0}, {0.25, 0.0}, {0.25, 0.7}, {1.0, 0.2}};
    pinEnergy("a levelled clip", playEnergy(levelled, params, timeline, 0.2, 3.0, equalizer));
    params.pulses = {TransientShape::square, 70.0, 1.5};
    params.transposition = -24.0;
    timeline.changes.clear();
    pinEnergy("a levelled clip with square pulses", playEnergy(levelled, params, timeline, 0.2, 3.0, equalizer));
    pinEnergy("an empty clip", playEnergy(Clip{}, params, timeline, 0.2, 3.0, equalizer));
    levelled.bands.clear();
    levelled.noise.clear();
    pinEnergy("events under an envelope", playEnergy(levelled, params, timeline, 0.2, 3.0, equalizer));
    // Pitches below 1 Hz count as 1 Hz.
    Clip low;
    low.duration = 1.0;
    low.bands = {{0.01, 0.1, 0.9, 0, {{0.0, 1.0}}, {}}, {0.1, 0.5, 0.9, 0, {{0.0, 1.0}}, {{0.0, 0.3}, {1.0, 0.7}}}};
    params.transposition = 80.0;
    const auto energy = playEnergy(low, params, timeline, 0.0, 3.0, equalizer);
    const double gain = std::abs(equalizer.response(Hertz(std::pow(2.0, 80.0 / 12.0)), fs));
    CHECK(energy.gains.bands[0] == Approx(gain));
    CHECK(energy.gains.bands[1] == Approx(gain));
}
