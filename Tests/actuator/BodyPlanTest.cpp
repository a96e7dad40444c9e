#include "actuator/BodyReference.h"
#include "support/Catch.h"

#include <pacini/actuator/BodyDesign.h>
#include <pacini/actuator/BodyPlan.h>

using namespace pacini;
using namespace pacini::test;

namespace
{
double skinError(const BodyChain& chain, const BodyChain& simpler, double f)
{
    const auto wanted = chain.response(BodyPoint::skin, Hertz(f));
    return std::abs(simpler.response(BodyPoint::skin, Hertz(f)) - wanted) / std::abs(wanted);
}
} // namespace

TEST_CASE("A merged joint costs less than 1.1 times the square of frequency over joint frequency", "[actuator][body]")
{
    for (const double stiffness : {4e8, 1e9, 1e10, 1e11, 1e12, 1e13})
        for (const double ratio : {1e-4, 0.05, 1.0, 2.0})
        {
            BodyParams body;
            body.jointStiffness = stiffness;
            setJointDampingRatio(body, ratio);
            const auto plan = planBody(body, {65.93, 3.969});
            REQUIRE(plan.chain.shape == BodyShape::rigid);
            REQUIRE(plan.omissions.size() == 1);
            CHECK(plan.omissions[0].part == "joint");
            CHECK(plan.omissions[0].predictedError < 1e-3);
            const auto whole = makeBodyChain(body, {65.93, 3.969});
            for (int i = 0; i <= 200; ++i)
            {
                const double f = 30.0 * std::pow(1000.0 / 30.0, i / 200.0);
                const double over = f / whole.jointFrequency().value;
                REQUIRE(skinError(whole, plan.chain, f) <= 1.1 * over * over + 1e-6);
            }
        }
}

TEST_CASE("What is left out costs no more than predicted, and that is below the tolerance", "[actuator][body]")
{
    BodyDraws draws;
    int rigid = 0, skinless = 0;
    for (int i = 0; i < bodyDraws; ++i)
    {
        auto drawn = draws.next();
        if (i % 5 == 0)
        {
            drawn.body.deviceMass = 3.0;
            drawn.body.skinMass *= 1e-4;
            drawn.body.skinStiffness *= 1e-2;
            drawn.body.skinDamping *= 1e-3;
        }
        for (const double tolerance : {-60.0, -40.0})
        {
            const auto plan = planBody(drawn.body, drawn.resonance, Decibels(tolerance));
            if (plan.chain.shape == BodyShape::elastic)
            {
                CHECK(plan.omissions.empty());
                continue;
            }
            (plan.chain.shape == BodyShape::rigid ? rigid : skinless) += 1;
            REQUIRE(plan.omissions.size() == 1);
            const double predicted = plan.omissions[0].predictedError;
            REQUIRE(predicted < Decibels(tolerance).gain());
            const auto whole = makeBodyChain(drawn.body, drawn.resonance);
            double largest = 0.0;
            for (int k = 0; k <= 300; ++k)
                largest = std::max(largest, skinError(whole, plan.chain, 30.0 * std::pow(1000.0 / 30.0, k / 300.0)));
            CAPTURE(predicted, largest);
            REQUIRE(largest <= 1.05 * predicted);
        }
    }
    CHECK(rigid > bodyDraws / 4);
    CHECK(skinless > bodyDraws / 20);
}

TEST_CASE("Without a tolerance, and where joint and skin matter, everything is kept", "[actuator][body]")
{
    BodyParams stiff;
    stiff.jointStiffness = 1e12;
    const double minusInfinity = -std::numeric_limits<double>::infinity();
    CHECK(planBody(stiff, {}, Decibels(minusInfinity)).chain.shape == BodyShape::elastic);
    CHECK(planBody({}, {}).chain.shape == BodyShape::elastic);
    // A resonance so sharp that the little which the joint gives shifts it by more than the tolerance.
    stiff.jointStiffness = 4e8;
    CHECK(planBody(stiff, {800.0, 4.0}).chain.shape == BodyShape::rigid);
    CHECK(planBody(stiff, {800.0, 100.0}).chain.shape == BodyShape::elastic);
}
