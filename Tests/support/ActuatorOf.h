#pragma once

// Actuators for tests: a profile from what most of them set.

#include <pacini/actuator/Profile.h>

namespace pacini::test
{

[[nodiscard]] inline Profile actuatorOf(Technology technology, Resonance resonance, ActuatorRange range)
{
    Profile profile;
    profile.technology = technology;
    profile.resonance = resonance;
    profile.range = range;
    return profile;
}

} // namespace pacini::test
