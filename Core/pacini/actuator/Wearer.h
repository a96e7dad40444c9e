#pragma once

// Variation between wearers: the mechanics of the skin under the same device.

#include <pacini/actuator/Profile.h>
#include <pacini/foundation/Random.h>

#include <cmath>

namespace pacini
{

/// Simulated wearers beside the one that a profile describes, which is wearer 0.
inline constexpr unsigned simulatedWearers = 14;

/// `body` on wearer 0 to 14: mass, stiffness and damping of the skin are those of the profile times a factor each,
/// drawn evenly in octaves from 1/2 to 2, the same for a wearer whenever and on whichever profile.
///
/// Where the range comes from: assumed. It has not been fitted to measured people; it says how much hangs on numbers of
/// the skin that a profile mostly assumes as well.
[[nodiscard]] inline BodyParams bodyOn(unsigned wearer, BodyParams body) noexcept
{
    if (wearer == 0)
        return body;
    Random random(wearer);
    const auto factor = [&random]
    {
        return std::exp2(random.uniform(-1.0, 1.0));
    };
    body.skinMass *= factor();
    body.skinStiffness *= factor();
    body.skinDamping *= factor();
    return body;
}

} // namespace pacini
