#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/actuator/ProtectionParams.h>

#include <cmath>
#include <string>

using namespace pacini;

namespace
{

/// Travel, coil and body, all with limits that a drive can reach.
Profile strainedProfile()
{
    Profile profile;
    profile.technology = Technology::vca;
    profile.resonance = {67.0, 3.97};
    profile.range.lowFrequency = 33.0;
    profile.drive = {8.0, 1.5, 0.03, 2.5, 1.5e-3, 1e-3, 2.0}; // ohm, V, W, s, m, m
    profile.body = BodyParams{};
    return profile;
}

} // namespace

TEST_CASE("Without a profile the protection has the limits that its parameters state", "[actuator][protection]")
{
    const ProtectionParams params;
    CHECK_FALSE(params.excursion.has_value());
    CHECK_FALSE(params.heat.has_value());
    CHECK(params.lowFrequency == Hertz(20.0));
    CHECK(params.lookAhead == Seconds(0.001));
    CHECK_FALSE(params.boundsAlone);
    CHECK(ExcursionParams{} == ExcursionParams{Hertz(67.0), 1.0, 1e-3, 1e-3, std::nullopt});
    CHECK(CoilHeatParams{} == CoilHeatParams{1.0, 1.0, Seconds(1.0)});
    CHECK(defaultThermalTime == 1.0);
    const ProtectionNeeds needs;
    CHECK(needs.excursion == ProtectionNeeds::Limit::unknown);
    CHECK(needs.heat == ProtectionNeeds::Limit::unknown);
    CHECK(needs.worstExcursion == 0.0);
    CHECK(needs.worstWorn == 0.0);
    CHECK(needs.worstPower == 0.0);
}

TEST_CASE("The power of a coil is that of a sinusoid, or of a motor that of a direct voltage", "[actuator][protection]")
{
    Profile profile = strainedProfile();
    const auto sinusoid = coilHeatParams(profile);
    REQUIRE(sinusoid.has_value());
    CHECK(sinusoid->fullDrivePower == Approx(2.0 * 3.0 * 3.0 / 8.0).epsilon(1e-14));
    CHECK(sinusoid->maxPower == 0.03);
    CHECK(sinusoid->thermalTime == Seconds(2.5));
    profile.technology = Technology::erm;
    CHECK(coilHeatParams(profile)->fullDrivePower == Approx(3.0 * 3.0 / 8.0).epsilon(1e-14));
    profile.drive.thermalTime.reset();
    CHECK(coilHeatParams(profile)->thermalTime == Seconds(1.0));
    for (auto member : {&ActuatorDrive::maxPower, &ActuatorDrive::impedance, &ActuatorDrive::maxVoltageRms})
    {
        Profile without = profile;
        (without.drive.*member).reset();
        CHECK_FALSE(coilHeatParams(without).has_value());
        CHECK(protectionNeeds(without).heat == ProtectionNeeds::Limit::unknown);
        CHECK(protectionNeeds(without).worstPower == 0.0);
        CHECK_FALSE(protectionParams(without, Seconds(0.0)).heat.has_value());
    }
}

TEST_CASE("The travel of an actuator is guarded with its overdrive, held still and worn", "[actuator][protection]")
{
    Profile profile = strainedProfile();
    const auto params = excursionParams(profile);
    REQUIRE(params.has_value());
    CHECK(params->frequency == Hertz(67.0));
    CHECK(params->q == 3.97);
    CHECK(params->excursion == 2e-3);
    CHECK(params->maxExcursion == 1.5e-3);
    REQUIRE(params->worn.has_value());
    const double stiffness = 0.012 * std::pow(2.0 * std::numbers::pi * 67.0, 2.0);
    CHECK(params->worn->force == Approx(2.0 * 1e-3 * stiffness).epsilon(1e-12));
    profile.body->force = 10.0;
    CHECK(wornChain(profile)->force == Approx(20.0).epsilon(1e-14));
    BodyChain expected = makeBodyChain(*profile.body, profile.resonance);
    expected.force = wornChain(profile)->force;
    CHECK(*wornChain(profile) == expected);

    const auto needs = protectionNeeds(profile);
    CHECK(needs.worstWorn == worstTravel(*wornChain(profile)));
    CHECK(needs.worstExcursion == needs.worstWorn);
    CHECK(needs.worstExcursion > worstExcursion(*excursionParams(profile)));
    profile.body.reset();
    CHECK_FALSE(wornChain(profile).has_value());
    CHECK(protectionNeeds(profile).worstWorn == 0.0);
    CHECK(protectionNeeds(profile).worstExcursion == worstExcursion(*excursionParams(profile)));

    Profile without = strainedProfile();
    without.drive.maxExcursion.reset();
    CHECK_FALSE(excursionParams(without).has_value());
    CHECK(wornChain(without).has_value());
    without.drive.excursion.reset();
    CHECK_FALSE(wornChain(without).has_value());
    without.drive.maxExcursion = 1e-3;
    CHECK_FALSE(excursionParams(without).has_value());
    CHECK(protectionNeeds(without).excursion == ProtectionNeeds::Limit::unknown);
    without = strainedProfile();
    without.technology = Technology::erm;
    CHECK_FALSE(wornChain(without).has_value());
    CHECK(excursionParams(without).has_value());
}

TEST_CASE("A limit that is reached exactly needs no guard, and one just below it does", "[actuator][protection]")
{
    using Limit = ProtectionNeeds::Limit;
    Profile profile = strainedProfile();
    const auto worst = protectionNeeds(profile);
    profile.drive.maxExcursion = worst.worstExcursion;
    profile.drive.maxPower = worst.worstPower;
    CHECK(protectionNeeds(profile).excursion == Limit::unharmed);
    CHECK(protectionNeeds(profile).heat == Limit::unharmed);
    CHECK_FALSE(protectionParams(profile, Seconds(0.0)).excursion.has_value());
    CHECK_FALSE(protectionParams(profile, Seconds(0.0)).heat.has_value());
    profile.drive.maxExcursion = worst.worstExcursion * (1.0 - 1e-9);
    profile.drive.maxPower = worst.worstPower * (1.0 - 1e-9);
    CHECK(protectionNeeds(profile).excursion == Limit::guarded);
    CHECK(protectionNeeds(profile).heat == Limit::guarded);

    // Where the worn mass stays within the travel, only the one that is held still is guarded.
    profile = strainedProfile();
    profile.body->skinStiffness = 1e8;
    profile.body->jointStiffness = 1e8;
    profile.body->deviceMass = profile.body->skinMass = 10.0;
    profile.body->force = 1e-3;
    const double worn = protectionNeeds(profile).worstWorn;
    const double still = worstExcursion(*excursionParams(profile));
    CAPTURE(worn, still);
    const double larger = std::max(worn, still), smaller = std::min(worn, still);
    profile.drive.maxExcursion = 0.5 * (larger + smaller);
    const auto params = protectionParams(profile, Seconds(0.0));
    REQUIRE(params.excursion.has_value());
    CHECK(params.excursion->worn.has_value() == (worn > still));
    profile.drive.maxExcursion = worn;
    if (worn < still)
        CHECK_FALSE(protectionParams(profile, Seconds(0.0)).excursion->worn.has_value());
    profile.drive.maxExcursion = 0.999 * worn;
    CHECK(protectionParams(profile, Seconds(0.0)).excursion->worn.has_value());
}

TEST_CASE("The protection of a profile has its limits, its low end and the look-ahead", "[actuator][protection]")
{
    const Profile profile = strainedProfile();
    const auto params = protectionParams(profile, Seconds(0.0004));
    CHECK(params.excursion == excursionParams(profile));
    CHECK(params.heat == coilHeatParams(profile));
    CHECK(params.lowFrequency == Hertz(33.0));
    CHECK(params.lookAhead == Seconds(0.0004));
    CHECK_FALSE(params.boundsAlone);
}

TEST_CASE("What becomes of the limits is said in words", "[actuator][protection]")
{
    Profile profile = strainedProfile();
    CHECK(protectionText(profile) == "travel is kept within its limit; heat is kept within its limit");
    CHECK(protectionText(profile, true) == "heat is kept within its limit");
    profile.drive.maxPower = 1e3;
    profile.drive.maxExcursion = 0.1;
    CHECK(protectionText(profile) == "no drive reaches the limit of travel; no drive reaches the limit of heat");
    CHECK(protectionText(profile, true) == "no drive reaches the limit of heat");
    profile.drive.maxExcursion.reset();
    CHECK(protectionText(profile) == "the profile names no limit of travel; no drive reaches the limit of heat");
    profile.drive.maxPower.reset();
    CHECK(protectionText(profile) == "the profile names no limit of travel; the profile names no limit of heat");
    CHECK(protectionText(profile, true) == "the profile names no limit of heat");
}

TEST_CASE("The worst travel of a mass whose base is held still is that of the series of its swings",
          "[actuator][protection]")
{
    // A step goes 1 + r past rest in the first half swing, r = exp(-pi zeta / sqrt(1 - zeta^2)); turned at each end the
    // swings grow to the sum 1 + 2 r + 2 r^2 + ...
    for (const double q : {0.500001, 0.51, 0.7, 1.0, 4.0, 100.0})
    {
        CAPTURE(q);
        const double zeta = 0.5 / q;
        const double r = std::exp(-std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta));
        CHECK(worstExcursion({Hertz(67.0), q, 3e-3, 1e-3, {}}) == Approx(3e-3 * (1.0 + r) / (1.0 - r)).epsilon(1e-12));
    }
    for (const double q : {0.5, 0.3, 0.01})
        CHECK(worstExcursion({Hertz(67.0), q, 3e-3, 1e-3, {}}) == 3e-3);
}
