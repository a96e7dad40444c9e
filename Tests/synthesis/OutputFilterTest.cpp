#include "io/ProfileFile.h"
#include "io/ShippedProfiles.h"
#include "support/ActuatorOf.h"
#include "support/Catch.h"
#include "support/Measure.h"
#include "support/Paths.h"
#include "support/Render.h"

#include <pacini/actuator/OutputFilter.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

using namespace pacini;

namespace
{
constexpr double fs = 8000.0;
constexpr double tolerance = 0.05; // dB

Profile resonant(double frequency, double q)
{
    return test::actuatorOf(Technology::lra, {frequency, q}, {20.0, 1000.0, 60.0});
}

/// How much stronger than without flattening the rendered drive of a tone is once the filter has settled, dB.
double rise(const Profile& profile, double frequency, double maxBoost)
{
    CompileParams params;
    params.sampleRate = fs;
    params.adaptation.frequencies = params.adaptation.voices = params.adaptation.dynamicRange = false;
    params.adaptation.strength = 0.0;
    ScenePlayerParams playing;
    playing.sampleRate = fs;
    playing.protect = false;
    const Resonance target = flatteningOf(profile, Decibels(maxBoost))->target;
    const double settled = 3.0 * target.q / target.frequency + 0.05; // 80 dB down
    Clip clip;
    clip.duration = settled + 20.0 / frequency;
    const double end = clip.duration;
    clip.bands = {{frequency / 1.1, frequency, frequency * 1.1, 0, {{0.0, 0.1}, {end, 0.1}}, {{0.0, frequency}}}};
    const auto level = [&](double boost)
    {
        params.adaptation.maxBoost = Decibels(boost);
        const auto y = test::drive(clip, profile, params, playing);
        const auto last = static_cast<std::size_t>(std::lround(20.0 / frequency * fs));
        return std::abs(test::spectrumAt(std::span<const float>(y).last(last), frequency, fs));
    };
    return 20.0 * std::log10(level(maxBoost) / level(0.0));
}

/// The highest rise between two frequencies, in which it has one summit.
double highestRise(const Profile& profile, double low, double high, double maxBoost)
{
    const double golden = std::numbers::phi - 1.0;
    double highest = -1000.0;
    const auto at = [&](double octave)
    {
        const double found = rise(profile, std::exp2(octave), maxBoost);
        highest = std::max(highest, found);
        return found;
    };
    double from = std::log2(low), to = std::log2(high);
    double left = to - golden * (to - from), right = from + golden * (to - from);
    double leftRise = at(left), rightRise = at(right);
    for (int i = 0; i < 16; ++i)
        if (leftRise > rightRise)
        {
            to = right;
            right = left;
            rightRise = leftRise;
            left = to - golden * (to - from);
            leftRise = at(left);
        }
        else
        {
            from = left;
            left = right;
            leftRise = rightRise;
            right = from + golden * (to - from);
            rightRise = at(right);
        }
    return highest;
}
} // namespace

TEST_CASE("The drive of no tone is raised by more than the largest boost", "[adaptation]")
{
    for (const bool worn : {false, true})
        for (const double q : {1.0, 2.0, 5.0, 10.0, 20.0, 40.0, 80.0, 160.0, 400.0, 1000.0})
            for (const double boost : {6.0, 20.0})
            {
                CAPTURE(worn, q, boost);
                Profile profile = resonant(175.0, q);
                if (worn)
                    profile.body = BodyParams{0.15, 0.0015, 0.1, 4.0e4, 5.0, 0.01, 800.0, 2.5};
                const double highest = highestRise(profile, 30.0, 175.0, boost);
                CHECK(highest <= boost + tolerance);
                if (q >= 40.0) // and a sharp one needs all of it
                    CHECK(highest >= boost - 1.0);
            }
}

TEST_CASE("On shipped actuators the drive of no tone is raised by more than the largest boost", "[adaptation]")
{
    for (const auto& entry : shippedProfiles(sourceFolder()))
    {
        const auto profile = readProfile(entry.path);
        REQUIRE(profile.ok());
        for (const double boost : {1.0, 6.0, 12.0})
        {
            CAPTURE(entry.name, boost);
            const auto flattening = flatteningOf(*profile, Decibels(boost));
            if (!flattening)
                continue;
            // By default only the sharpest one has to keep its resonance a little nearer.
            if (boost == 6.0)
                CHECK(flattening->octaves > (entry.name == "lra-235-narrow" ? 0.48 : 0.4999));
            CHECK(highestRise(*profile, 10.0, flattening->actuator.frequency, boost) <= boost + tolerance);
            for (const double frequency : {20.0, 60.0, 180.0, 540.0, 1500.0})
                CHECK(rise(*profile, frequency, boost) <= boost + tolerance);
        }
    }
}

TEST_CASE("The bound holds for any resonance, sharpness, boost and rate", "[adaptation]")
{
    Random random(5);
    const auto wide = [&](double low, double high)
    {
        return low * std::pow(high / low, random.uniform());
    };
    int raised = 0;
    for (int i = 0; i < 3000; ++i)
    {
        const Profile profile = resonant(wide(1.0, 20000.0), wide(0.01, 1000.0));
        const double boost = wide(0.1, 40.0);
        const double rate = wide(2000.0, 768000.0);
        CAPTURE(profile.resonance.frequency, profile.resonance.q, boost, rate);
        const auto flattening = flatteningOf(profile, Decibels(boost));
        REQUIRE(flattening.has_value());
        CHECK(flattening->octaves >= 0.0);
        const auto filter = designOutputFilter({{}, flattening}, rate);
        double highest = 0.0;
        const auto look = [&](double frequency)
        {
            if (frequency <= 0.5 * rate)
                highest = std::max(highest, std::abs(filter.response(Hertz(frequency), rate)));
        };
        for (double f = 0.5; f < 0.5 * rate; f *= 1.1)
            look(f);
        look(0.5 * rate);
        for (const Resonance& near : {flattening->actuator, flattening->target})
            for (double part = -3.0; part <= 3.0; part += 0.02) // of the pole's half width
                look(near.frequency * std::exp(part / std::max(near.q, 0.5)));
        CHECK(20.0 * std::log10(highest) <= boost + tolerance);
        raised += 20.0 * std::log10(highest) > 0.4 * boost ? 1 : 0;
    }
    CHECK(raised > 2500);
}
