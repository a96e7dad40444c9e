#include "support/Catch.h"
#include "support/HeapGuard.h"

#include <pacini/actuator/FrequencyMap.h>
#include <pacini/foundation/Random.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace pacini;

namespace
{

Profile withRange(FrequencyMapping mapping, double low, double high, double resonance)
{
    Profile profile;
    profile.frequencyMapping = mapping;
    profile.range.lowFrequency = low;
    profile.range.highFrequency = high;
    profile.resonance.frequency = resonance;
    return profile;
}

/// All octaves of f in the range; the one nearest to the resonance, or the end nearest to any octave.
double foldedByHand(double f, double low, double high, double resonance)
{
    if (f >= low && f <= high)
        return f;
    double best = 0.0;
    double nearest = std::numeric_limits<double>::infinity();
    for (int octave = -20; octave <= 20; ++octave)
    {
        const double g = f * std::pow(2.0, octave);
        const double distance = std::abs(std::log2(g / resonance));
        if (g >= low && g <= high && distance < nearest - 1e-12)
        {
            best = g;
            nearest = distance;
        }
    }
    if (best > 0.0)
        return best;
    for (int octave = -20; octave <= 20; ++octave)
        for (const double end : {low, high})
        {
            const double distance = std::abs(std::log2(f * std::pow(2.0, octave) / end));
            if (distance < nearest - 1e-12)
            {
                best = end;
                nearest = distance;
            }
        }
    return best;
}

} // namespace

TEST_CASE("Every frequency is mapped into the range, whatever it is", "[actuator]")
{
    Random random(1);
    for (const auto mapping : {FrequencyMapping::clamp, FrequencyMapping::rescale, FrequencyMapping::fold})
        for (int i = 0; i < 500; ++i)
        {
            const double low = 5.0 * std::pow(400.0, random.uniform());
            const double high = low * std::pow(50.0, random.uniform(0.01, 1.0));
            const FrequencyMap map(withRange(mapping, low, high, random.uniform(1.0, 1500.0)));
            for (const double f : {5.0 * std::pow(400.0, random.uniform()), low, high, 2.0 * high, 0.5 * low, 0.0, -5.0,
                                   1e-300, 5e-324, 1e300, std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
            {
                CAPTURE(low, high, f);
                const double g = map(f);
                REQUIRE(g >= low);
                REQUIRE(g <= high);
            }
        }
}

TEST_CASE("Clamped and rescaled frequencies never fall and never jump", "[actuator]")
{
    for (const auto mapping : {FrequencyMapping::clamp, FrequencyMapping::rescale})
    {
        const FrequencyMap map(withRange(mapping, 150.0, 250.0, 175.0));
        double before = map(20.0);
        for (double octaves = std::log2(20.0); octaves < std::log2(1500.0); octaves += 0.001)
        {
            const double g = map(std::exp2(octaves));
            REQUIRE(g >= before);
            REQUIRE(g <= before * 1.0008);
            before = g;
        }
        CHECK(before == 250.0);
    }
}

TEST_CASE("Rescaled frequencies keep equal intervals equal", "[actuator]")
{
    const FrequencyMap map(withRange(FrequencyMapping::rescale, 50.0, 500.0, 175.0));
    CHECK(map(30.0) == Approx(50.0));
    CHECK(map(1000.0) == Approx(500.0));
    CHECK(map(std::sqrt(30.0 * 1000.0)) == Approx(std::sqrt(50.0 * 500.0)));
    CHECK(map(80.0) / map(40.0) == Approx(map(800.0) / map(400.0)));
    const FrequencyMap same(withRange(FrequencyMapping::rescale, 30.0, 1000.0, 67.0));
    for (const double f : {30.0, 67.0, 333.0, 1000.0})
        CHECK(same(f) == Approx(f));
}

TEST_CASE("Folded frequencies are the octave nearest to the resonance", "[actuator]")
{
    const FrequencyMap wide(withRange(FrequencyMapping::fold, 50.0, 500.0, 175.0));
    CHECK(wide(30.0) == Approx(240.0));
    CHECK(wide(60.0) == Approx(60.0));    // shown already
    CHECK(wide(1000.0) == Approx(125.0)); // 250 is 0.51 octaves away, 125 is 0.49
    const FrequencyMap narrow(withRange(FrequencyMapping::fold, 150.0, 250.0, 175.0));
    CHECK(narrow(80.0) == Approx(160.0));
    CHECK(narrow(70.0) == 150.0); // 140 is nearer to 150 than 280 to 250
    CHECK(narrow(1050.0) == 250.0);

    Random random(4);
    for (int i = 0; i < 2000; ++i)
    {
        const double low = 5.0 * std::pow(200.0, random.uniform());
        const double high = low * std::pow(30.0, random.uniform(0.01, 1.0));
        const double resonance = 5.0 * std::pow(400.0, random.uniform());
        const double f = 1.0 * std::pow(5000.0, random.uniform());
        CAPTURE(low, high, resonance, f);
        const FrequencyMap map(withRange(FrequencyMapping::fold, low, high, resonance));
        REQUIRE(map(f) == Approx(foldedByHand(f, low, high, resonance)).epsilon(1e-9));
    }
}

TEST_CASE("Mapping takes no memory, and mapping twice changes nothing more, except for rescaling", "[actuator]")
{
    Random random(2);
    for (const auto mapping : {FrequencyMapping::clamp, FrequencyMapping::fold})
    {
        const FrequencyMap map(withRange(mapping, 90.0, 400.0, 175.0));
        bool same = true;
        const test::HeapGuard guard;
        for (int i = 0; i < 1000; ++i)
        {
            const double g = map(random.uniform(1.0, 5000.0));
            same = same && map(g) == g;
        }
        CHECK(guard.traffic() == 0);
        CHECK(same);
    }
}
