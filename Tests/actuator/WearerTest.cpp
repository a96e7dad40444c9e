// Simulated wearers.

#include "support/Catch.h"

#include <pacini/actuator/Wearer.h>

#include <algorithm>
#include <set>

using namespace pacini;

TEST_CASE("wearer 0 is the profile's own", "[wearer]")
{
    const BodyParams body;
    CHECK(bodyOn(0, body) == body);
}

TEST_CASE("wearers have half to twice the skin, each another one, and the same device", "[wearer]")
{
    BodyParams body;
    body.skinMass = body.skinStiffness = body.skinDamping = 1.0;
    double lightest = 1.0, heaviest = 1.0;
    std::set<double> masses, stiffnesses, dampings;
    for (unsigned wearer = 1; wearer <= simulatedWearers; ++wearer)
    {
        BodyParams worn = bodyOn(wearer, body);
        CHECK(bodyOn(wearer, body) == worn);
        for (const double factor : {worn.skinMass, worn.skinStiffness, worn.skinDamping})
            CHECK((factor >= 0.5 && factor <= 2.0));
        lightest = std::min(lightest, worn.skinMass);
        heaviest = std::max(heaviest, worn.skinMass);
        masses.insert(worn.skinMass);
        stiffnesses.insert(worn.skinStiffness);
        dampings.insert(worn.skinDamping);
        worn.skinMass = worn.skinStiffness = worn.skinDamping = 1.0;
        CHECK(worn == body);
    }
    CHECK(masses.size() == simulatedWearers);
    CHECK(stiffnesses.size() == simulatedWearers);
    CHECK(dampings.size() == simulatedWearers);
    // Of fourteen drawn evenly in octaves, some lie in the outer quarters.
    CHECK(lightest < 0.71);
    CHECK(heaviest > 1.41);
}

TEST_CASE("a wearer differs from another body by the same factors", "[wearer]")
{
    const BodyParams body;
    BodyParams other = body;
    other.skinMass *= 3.0;
    other.skinDamping *= 0.1;
    CHECK(bodyOn(5, other).skinMass == Approx(3.0 * bodyOn(5, body).skinMass).epsilon(1e-14));
    CHECK(bodyOn(5, other).skinDamping == Approx(0.1 * bodyOn(5, body).skinDamping).epsilon(1e-14));
}
