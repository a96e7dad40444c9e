#include "EqualizerReference.h"
#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/linearize/EqualizerCost.h>

using namespace pacini;
using namespace pacini::test;

namespace
{
Profile coilProfile()
{
    Profile profile;
    profile.resonance = {67.0, 4.0};
    profile.range = {20.0, 1000.0, 60.0};
    profile.drive.impedance = 8.8;
    profile.drive.maxVoltageRms = 1.0;
    profile.drive.maxExcursion = 0.003;
    profile.drive.excursion = 0.0007;
    return profile;
}
} // namespace

TEST_CASE("No equaliser costs nothing", "[linearize]")
{
    const EqualizerCost cost = equalizerCost(coilProfile(), {}, 48000.0);
    CHECK(cost.powerChange == Approx(0.0).margin(1e-12));
    CHECK(cost.excursionChange == Approx(0.0).margin(1e-12));
    REQUIRE(cost.power.has_value());
    CHECK(*cost.power == Approx(1.0 / 8.8));
    REQUIRE(cost.excursion.has_value());
    // a resonator of q 4 moves q / sqrt(1 - 1 / (4 q^2)) times as far at its peak, at sqrt(1 - 1 / (2 q^2)) of f0
    CHECK(*cost.excursion == Approx(0.0007 / 0.003 * 4.0 / std::sqrt(1.0 - 1.0 / 64.0)).epsilon(1e-4));
    CHECK(cost.excursionFrequency == Approx(67.0 * std::sqrt(1.0 - 1.0 / 32.0)).epsilon(3e-3));
}

TEST_CASE("The power of an equaliser is that of its response over the spectrum", "[linearize]")
{
    const EqualizerSections sections = {{EqualizerType::peak, 30.0, 16.0, 1.5, 2},
                                        {EqualizerType::peak, 68.0, -10.0, 1.6, 2}};
    for (const auto reference : {ReferenceSpectrum::flat, ReferenceSpectrum::pink})
    {
        // the middle rule over Hz, where the code steps by ratios
        double plain = 0.0, equalized = 0.0;
        for (double f = 20.005; f < 1000.0; f += 0.01)
        {
            const double density = reference == ReferenceSpectrum::flat ? 1.0 : 1.0 / f;
            plain += density;
            equalized += density * std::pow(10.0, cookbookLevel(sections, f, 48000.0) / 10.0);
        }
        const EqualizerCost cost = equalizerCost(coilProfile(), sections, 48000.0, reference);
        CHECK(cost.powerChange == Approx(10.0 * std::log10(equalized / plain)).margin(1e-3));
        CHECK(*cost.power == Approx(equalized / plain / 8.8).epsilon(1e-3));
    }
}

TEST_CASE("A boost below the resonance costs travel, a cut at it gives some back", "[linearize]")
{
    const EqualizerCost boosted = equalizerCost(coilProfile(), {{EqualizerType::peak, 30.0, 16.0, 1.5, 2}}, 48000.0);
    CHECK(boosted.powerChange > 4.0);
    CHECK(boosted.excursionChange > 3.0);
    CHECK(boosted.excursionFrequency < 60.0);
    const EqualizerCost cut = equalizerCost(coilProfile(), {{EqualizerType::peak, 67.0, -12.0, 2.0, 2}}, 48000.0);
    CHECK(cut.powerChange < 0.0);
    CHECK(cut.excursionChange < -8.0);
}

TEST_CASE("What a profile does not say is not predicted", "[linearize]")
{
    Profile profile = coilProfile();
    profile.drive = {};
    const EqualizerCost cost = equalizerCost(profile, {{EqualizerType::peak, 30.0, 6.0, 1.0, 2}}, 48000.0);
    CHECK_FALSE(cost.power.has_value());
    CHECK_FALSE(cost.excursion.has_value());
    CHECK(cost.powerChange > 0.0);
    CHECK(std::isfinite(equalizerCost(profile, {}, 1000.0).excursionChange));
}

TEST_CASE("Costs of equalisers are those that they were", "[linearize]")
{
    const EqualizerSections sections = {{EqualizerType::peak, 30.0, 16.0, 1.5, 2},
                                        {EqualizerType::lowShelf, 90.0, -6.0, 0.7, 2},
                                        {EqualizerType::peak, 700.0, 9.0, 2.0, 2}};
    std::vector<double> values;
    for (const double fs : {1500.0, 48000.0})
        for (const auto reference : {ReferenceSpectrum::flat, ReferenceSpectrum::pink})
            for (const double high : {60.0, 1000.0})
            {
                Profile profile = coilProfile();
                profile.range.lowFrequency = 40.0;
                profile.range.highFrequency = high;
                const auto cost = equalizerCost(profile, sections, fs, reference);
                values.insert(values.end(), {cost.powerChange, *cost.power, std::log(cost.excursionFrequency),
                                             cost.excursionChange, *cost.excursion});
            }
    checkPinned("linearize/cost", values);
    // pink noise is the usual reference
    CHECK(equalizerCost(coilProfile(), sections, 48000.0).powerChange ==
          equalizerCost(coilProfile(), sections, 48000.0, ReferenceSpectrum::pink).powerChange);
    // each of two numbers is needed
    for (int missing = 0; missing < 4; ++missing)
    {
        Profile profile = coilProfile();
        if (missing == 0)
            profile.drive.impedance.reset();
        if (missing == 1)
            profile.drive.maxVoltageRms.reset();
        if (missing == 2)
            profile.drive.excursion.reset();
        if (missing == 3)
            profile.drive.maxExcursion.reset();
        const auto cost = equalizerCost(profile, sections, 48000.0);
        CHECK(cost.power.has_value() == (missing > 1));
        CHECK(cost.excursion.has_value() == (missing < 2));
    }
    Profile loud = coilProfile();
    loud.drive.maxVoltageRms = 3.0;
    CHECK(*equalizerCost(loud, {}, 48000.0).power == Approx(9.0 / 8.8));
    CHECK(EqualizerCost{}.powerChange == 0.0);
    CHECK(EqualizerCost{}.excursionFrequency == 0.0);
    CHECK(EqualizerCost{}.excursionChange == 0.0);
}
