#include "io/ProfileFile.h"
#include "io/ShippedProfiles.h"
#include "support/ActuatorOf.h"
#include "support/Catch.h"
#include "support/Paths.h"

#include <pacini/actuator/ActuatorFit.h>
#include <pacini/actuator/Strength.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
constexpr double fs = 48000.0;

Profile resonant(double frequency, double q)
{
    Profile profile = test::actuatorOf(Technology::lra, {frequency, q}, {0.5 * frequency, 2.0 * frequency, 40.0});
    profile.polyphony = 1;
    return profile;
}

ActuatorFit fitted(const Profile& profile, double strength)
{
    return fitActuator(profile, {6_dB, strength});
}

/// Acceleration of a mass on a spring whose base is held still, relative to that far above its resonance.
double acceleration(const Resonance& resonance, double frequency)
{
    const double x = frequency / resonance.frequency;
    return x * x / std::abs(std::complex<double>(1.0 - x * x, x / resonance.q));
}

/// dB that the fit's filter takes from a tone.
double lossAt(const ActuatorFit& fit, double frequency)
{
    const auto filter = designOutputFilter({fit.equalizer, fit.flattening}, fs);
    return -20.0 * std::log10(std::abs(filter.response(Hertz(frequency), fs)));
}

template <typename Check>
void forEachProfile(Check check)
{
    for (const ShippedProfile& shipped : shippedProfiles(sourceFolder()))
    {
        CAPTURE(shipped.name);
        const auto profile = readProfile(shipped.path);
        REQUIRE(profile.ok());
        check(shipped.name, *profile);
    }
}

Resonance wornResonance(const Profile& profile)
{
    return profile.body ? loadedResonance(*profile.body, profile.resonance) : profile.resonance;
}

/// How long after the start of a tone on the resonance of `profile` its mass swings with 90 % of the last amplitude,
/// and that amplitude, when the drive is the fit's, within +-1. The mass is a recursion with poles at exp(p / fs).
std::pair<double, double> riseOf(const Profile& profile, const ActuatorFit& fit, double amplitude)
{
    const double w = 2.0 * std::numbers::pi * profile.resonance.frequency / fs;
    const double decay = std::exp(-0.5 * w / profile.resonance.q);
    const double q = profile.resonance.q;
    const double a1 = -2.0 * decay * std::cos(w * std::sqrt(1.0 - 0.25 / (q * q)));
    OutputFilter filter;
    filter.prepare({fs, 1});
    filter.setParams({fit.equalizer, fit.flattening});
    filter.reset();
    std::vector<double> peaks;
    const auto period = static_cast<std::size_t>(std::lround(2.0 * std::numbers::pi / w));
    double y1 = 0.0, y2 = 0.0;
    for (std::size_t n = 0; n < static_cast<std::size_t>(fs / 2.0); ++n)
    {
        float drive = static_cast<float>(amplitude * std::sin(w * static_cast<double>(n)));
        filter.process(std::span(&drive, 1), std::span(&drive, 1));
        const double y = std::clamp(static_cast<double>(drive), -1.0, 1.0) - a1 * y1 - decay * decay * y2;
        y2 = y1;
        y1 = y;
        if (n % period == 0)
            peaks.push_back(0.0);
        peaks.back() = std::max(peaks.back(), std::abs(y));
    }
    const double last = peaks[peaks.size() - 2];
    const auto risen = std::find_if(peaks.begin(), peaks.end(), [last](double peak) { return peak >= 0.9 * last; });
    return {static_cast<double>(risen - peaks.begin()) * static_cast<double>(period) / fs, last};
}
} // namespace

TEST_CASE("Without strength an actuator is as flat as it can be", "[actuator]")
{
    forEachProfile(
        [](const std::string&, const Profile& profile)
        {
            for (const double boost : {0.0, 6.0, 12.0})
            {
                const ActuatorFit fit = fitActuator(profile, {Decibels(boost), 0.0});
                const auto flat = flatteningOf(profile, Decibels(boost));
                CHECK(fit.flattening == flat);
                CHECK(fit.equalizer == profile.equalizer);
                CHECK(fit.towardsResonance == 0.0);
                const double ratio = flat ? std::exp2(flat->octaves) : 1.0;
                CHECK(fit.range.lowFrequency == Approx(std::max(1.0, profile.range.lowFrequency / ratio)));
                CHECK(fit.range.highFrequency == Approx(profile.range.highFrequency * ratio));
                CHECK(fit == fitActuator(profile, {Decibels(boost), std::numeric_limits<double>::quiet_NaN()}));
                CHECK(fit == fitActuator(profile, {Decibels(boost), -1.0}));
                CHECK(fitActuator(profile, {Decibels(boost), 1.0}) == fitActuator(profile, {Decibels(boost), 2.0}));
            }
        });
}

TEST_CASE("The half-power band is where a mass on a spring is accelerated within 3 dB of its best", "[actuator]")
{
    for (const double q : {0.4, 0.7, 0.8, 1.0, 1.2, 1.27, 1.31, 2.0, 4.0, 10.0, 100.0})
    {
        CAPTURE(q);
        const Resonance resonance{170.0, q};
        const auto [low, high] = detail::halfPowerBand(resonance);
        double best = 1.0; // far above
        for (double octave = -4.0; octave < 8.0; octave += 1e-5)
            best = std::max(best, acceleration(resonance, 170.0 * std::exp2(octave)));
        const double half = best / std::numbers::sqrt2;
        CHECK(acceleration(resonance, low) == Approx(half).epsilon(1e-5));
        if (std::isinf(high))
            CHECK(half <= 1.0);
        else
            CHECK(acceleration(resonance, high) == Approx(half).epsilon(1e-5));
        CHECK(low < high);
        CHECK(acceleration(resonance, 0.99 * low) < half);
        if (q >= 10.0) // as everyone knows them
            CHECK(high - low == Approx(170.0 / q).epsilon(0.05));
    }
}

TEST_CASE("What is lost at the resonance falls with the strength, to nothing", "[actuator]")
{
    forEachProfile(
        [](const std::string&, const Profile& profile)
        {
            const auto flat = fitted(profile, 0.0);
            if (!flat.flattening)
                return;
            const double frequency = flat.flattening->actuator.frequency;
            const double most = lossAt(flat, frequency);
            double before = most;
            for (int i = 1; i <= 100; ++i)
            {
                const double strength = 0.01 * i;
                CAPTURE(strength);
                const double loss = lossAt(fitted(profile, strength), frequency);
                if (most > 0.0)
                    CHECK(loss <= before + 1e-3);
                CHECK(loss <= std::max(24.0, most) * std::pow(1.0 - strength, 3.0) + 0.02);
                before = loss;
            }
            CHECK(before == Approx(0.0).margin(0.02));
        });
}

TEST_CASE("The narrower a resonance, the more a strength draws in to it; with all of it nothing else is played",
          "[actuator]")
{
    double before = 0.0;
    for (const double q : {1.0, 2.0, 3.0, 5.0, 10.0, 20.0})
    {
        CAPTURE(q);
        const ActuatorFit fit = fitted(resonant(175.0, q), standardStrength);
        CHECK(fit.towardsResonance >= before);
        before = fit.towardsResonance;
    }
    CHECK(before > 0.7);
    CHECK(fitted(resonant(175.0, 1.0), standardStrength).towardsResonance == 0.0);
    forEachProfile(
        [](const std::string&, const Profile& profile)
        {
            if (profile.technology == Technology::erm || profile.technology == Technology::pcm)
                return;
            const ActuatorFit all = fitted(profile, 1.0);
            const Resonance worn = wornResonance(profile);
            CHECK(all.range.lowFrequency >= 0.999 * profile.range.lowFrequency);
            CHECK(all.range.highFrequency <= 1.001 * profile.range.highFrequency);
            double best = 1.0;
            for (double f = 5.0; f < 2000.0; f *= 1.001)
                best = std::max(best, acceleration(worn, f));
            for (const double f : {all.range.lowFrequency, all.range.highFrequency})
                CHECK(acceleration(worn, f) >= 0.7 * best);
        });
    // A resonance beyond the actuator's own range leaves the end that is nearest to it.
    Profile beyond = resonant(500.0, 10.0);
    beyond.range = {50.0, 200.0, 40.0};
    CHECK(fitted(beyond, 1.0).range.lowFrequency == Approx(200.0));
    CHECK(fitted(beyond, 1.0).range.highFrequency == Approx(200.0));
}

TEST_CASE("The fit moves without a jump from one strength to the next", "[actuator]")
{
    forEachProfile(
        [](const std::string&, const Profile& profile)
        {
            ActuatorFit before = fitted(profile, 0.0);
            for (int i = 1; i <= 2000; ++i)
            {
                const double strength = i / 2000.0;
                CAPTURE(strength);
                const ActuatorFit fit = fitted(profile, strength);
                CHECK(fit.towardsResonance >= before.towardsResonance);
                const double width = before.range.highFrequency - before.range.lowFrequency;
                CHECK(std::abs(fit.range.lowFrequency - before.range.lowFrequency) < 0.02 * width);
                CHECK(std::abs(fit.range.highFrequency - before.range.highFrequency) < 0.02 * width);
                CHECK(fit.range.lowFrequency <= fit.range.highFrequency);
                CHECK(fit.flattening.has_value() == before.flattening.has_value());
                for (const double f : {30.0, 75.0, 175.0, 235.0, 800.0})
                    CHECK(std::abs(lossAt(fit, f) - lossAt(before, f)) < 0.2);
                before = fit;
            }
        });
}

TEST_CASE("No tone is raised by more than a fit says, nor by more than makes up for its loss", "[actuator]")
{
    forEachProfile(
        [](const std::string&, const Profile& profile)
        {
            for (const double boost : {3.0, 6.0, 12.0})
                for (int i = 0; i <= 20; ++i)
                {
                    CAPTURE(boost, i);
                    const ActuatorFit fit = fitActuator(profile, {Decibels(boost), 0.05 * i});
                    if (!fit.flattening)
                        continue;
                    const double most = -Decibels::fromGain(fit.flattening->most).value;
                    for (double f = 1.0; f < 0.5 * fs; f *= 1.01)
                        REQUIRE(lossAt(fit, f) >= most - 1e-3);
                    CHECK(lossAt(fit, fit.flattening->actuator.frequency) >= std::min(0.0, -boost) - 1e-3);
                }
            // At the full strength that is the boost, or less, at a start on the resonance.
            if (const auto& all = fitted(profile, 1.0).flattening)
                CHECK(all->most <= Decibels(6.01).gain());
        });
}

TEST_CASE("On the resonance overdrive makes up for the rise time that it costs", "[actuator]")
{
    for (const auto& [frequency, q] : {std::pair{175.0, 10.0}, {235.0, 20.0}, {67.0, 4.5}})
    {
        CAPTURE(frequency, q);
        const Profile profile = resonant(frequency, q);
        const auto [slow, level] = riseOf(profile, fitActuator(profile, {0_dB, 0.0}), 0.3);
        const auto [fast, strongest] = riseOf(profile, fitted(profile, 1.0), 0.3);
        CHECK(strongest == Approx(level).epsilon(0.01)); // nothing is lost
        CHECK(fast < 0.6 * slow);                        // and it takes half the time: the drive is twice as high
        const auto [standard, felt] = riseOf(profile, fitted(profile, standardStrength), 0.3);
        CHECK(standard < 0.5 * slow);
        CHECK(felt > 0.5 * level);
    }
}

TEST_CASE("Strength matters to resonant actuators, and not to motors and plain signals", "[actuator]")
{
    CHECK(tradesStrength(resonant(175.0, 20.0)));
    CHECK(tradesStrength(resonant(60.0, 1.0)));
    Profile profile = resonant(175.0, 20.0);
    profile.technology = Technology::erm;
    CHECK_FALSE(tradesStrength(profile));
    CHECK_FALSE(tradesStrength(Profile{}));
}

TEST_CASE("A measured equaliser stays up to the standard strength and has no cuts at the full one", "[actuator]")
{
    Profile profile = resonant(70.0, 4.0);
    profile.technology = Technology::vca;
    profile.range = {20.0, 1000.0, 60.0};
    profile.equalizer = {{EqualizerType::peak, 68.0, -10.0, 1.6, 2},
                         {EqualizerType::lowShelf, 40.0, 3.0, 0.7, 2},
                         {EqualizerType::highShelf, 400.0, -2.0, 0.7, 2},
                         {EqualizerType::highpass, 20.0, 0.0, 0.7, 5}};
    for (const double strength : {0.0, 0.2, standardStrength})
    {
        const ActuatorFit fit = fitted(profile, strength);
        CHECK(fit.equalizer == profile.equalizer);
        CHECK(fit.range == profile.range);
        CHECK_FALSE(fit.flattening);
    }
    const double middle = 0.5 * (standardStrength + 1.0);
    CHECK(fitted(profile, middle).equalizer[0].gain == Approx(-5.0));
    CHECK(fitted(profile, middle).equalizer[1] == profile.equalizer[1]);
    CHECK(fitted(profile, middle).equalizer[2].gain == Approx(-1.0));
    const ActuatorFit all = fitted(profile, 1.0);
    CHECK(all.equalizer[0].gain == 0.0);
    CHECK(all.equalizer[1] == profile.equalizer[1]);
    CHECK(all.equalizer[2].gain == 0.0);
    CHECK(all.equalizer[3] == profile.equalizer[3]);
    CHECK(all.range.highFrequency < 100.0);
    for (const Technology technology : {Technology::erm, Technology::pcm})
    {
        profile.technology = technology;
        CHECK(fitted(profile, 1.0) == ActuatorFit{std::nullopt, profile.equalizer, profile.range, 0.0});
    }
}

TEST_CASE("The ring time is that of the resonance as it is played", "[actuator]")
{
    // q / (pi f); without room to raise the drive a resonance stays as sharp as it is at full strength.
    const Profile sharp = resonant(175.0, 10.0);
    CHECK(ringTime(sharp, fitActuator(sharp, {0_dB, 1.0})) == Approx(10.0 / (std::numbers::pi * 175.0)));
    const ActuatorFit usual = fitted(sharp, standardStrength);
    CHECK(ringTime(sharp, usual) ==
          Approx(usual.flattening->target.q / (std::numbers::pi * usual.flattening->target.frequency)));
    CHECK(ringTime(sharp, usual) < 0.5 * 10.0 / (std::numbers::pi * 175.0));

    // The peak whose gain and q undo a resonance of q 4 leaves one of q 1.
    Profile equalised = resonant(100.0, 4.0);
    const double fourth = 20.0 * std::log10(0.25);
    equalised.equalizer.pushBack({EqualizerType::peak, 100.0, fourth, 2.0});
    CHECK(ringTime(equalised, fitted(equalised, 0.0)) == Approx(1.0 / (std::numbers::pi * 100.0)));
    CHECK(ringTime(equalised, fitted(equalised, 1.0)) == Approx(4.0 / (std::numbers::pi * 100.0)));

    forEachProfile(
        [](const std::string&, const Profile& profile)
        {
            const double ring = ringTime(profile, fitActuator(profile, {}));
            const bool rings = profile.technology != Technology::erm && profile.technology != Technology::pcm;
            CHECK((rings ? ring > 0.0 && ring < profile.response.fallTime : ring == 0.0));
        });
}
