#include "actuator/BodyReference.h"
#include "support/Catch.h"
#include "support/Golden.h"

#include <pacini/actuator/BodyChain.h>

#include <limits>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("The chain's accelerations are those of the reference that solves the equations of motion",
          "[actuator][golden]")
{
    const auto data = golden("actuator");
    const auto& chain = data["chain"];
    const auto& p = chain["params"];
    const Resonance resonance{p["f0"].get<double>(), p["q0"].get<double>()};
    const BodyParams body{1.0, p["m0"], p["m_app"], p["k_app"], p["d_app"], p["m_skin"], p["k_skin"], p["d_skin"]};
    auto rigid = makeBodyChain(body, resonance);
    rigid.shape = BodyShape::rigid;
    const double tolerance = data["tol_rel"];
    for (std::size_t i = 0; i < data["freqs"].size(); ++i)
    {
        const Hertz f(data["freqs"][i].get<double>());
        const auto level = [&](BodyPoint point)
        {
            return std::abs(bodyFrequencyResponse(body, resonance, f, point));
        };
        CHECK(level(BodyPoint::movingMass) == Approx(chain["mag_mass"][i].get<double>()).epsilon(tolerance));
        CHECK(level(BodyPoint::device) == Approx(chain["mag_device"][i].get<double>()).epsilon(tolerance));
        CHECK(level(BodyPoint::skin) == Approx(chain["mag_skin"][i].get<double>()).epsilon(tolerance));
        const double together = chain["rigid_mag_device"][i];
        CHECK(std::abs(rigid.response(BodyPoint::device, f)) == Approx(together).epsilon(tolerance));
        CHECK(std::abs(rigid.response(BodyPoint::skin, f)) == Approx(together).epsilon(tolerance));
    }
}

TEST_CASE("The excursion is the double integral of what moving mass and device do differently", "[actuator]")
{
    BodyDraws draws;
    for (int i = 0; i < 50; ++i)
    {
        const auto drawn = draws.next();
        for (const BodyShape shape : {BodyShape::elastic, BodyShape::rigid, BodyShape::skinless})
            for (const double f : {1.0, 60.0, 900.0})
            {
                auto chain = makeBodyChain(drawn.body, drawn.resonance);
                chain.shape = shape;
                const std::complex<double> s(0.0, 2.0 * std::numbers::pi * f);
                const auto difference =
                    chain.response(BodyPoint::movingMass, Hertz(f)) - chain.response(BodyPoint::device, Hertz(f));
                const auto excursion = chain.response(BodyPoint::excursion, Hertz(f));
                CHECK(std::abs(difference / (s * s) - excursion) < 1e-9 * std::abs(excursion));
            }
    }
}

TEST_CASE("No net force acts on the free chain, and Newton's second law holds when the device is driven", "[actuator]")
{
    BodyParams body;
    auto free = makeBodyChain(body, {});
    free.shape = BodyShape::skinless;
    auto driven = makeBodyChain(body, {}, BodyForce::device);
    driven.shape = BodyShape::skinless;
    for (const double f : {0.5, 40.0, 5000.0})
    {
        const auto momentum = body.movingMass * free.response(BodyPoint::movingMass, Hertz(f)) +
                              body.deviceMass * free.response(BodyPoint::device, Hertz(f));
        CHECK(std::abs(momentum) < 1e-12);
        CHECK(driven.response(BodyPoint::skin, Hertz(f)).real() ==
              Approx(body.force / (body.movingMass + body.deviceMass)));
    }
    // Held by skin and driven at 0 Hz nothing accelerates; the spring of the actuator bears the force.
    CHECK(bodyFrequencyResponse(body, {}, 0_Hz) == 0.0);
    const double stiffness = body.movingMass * std::pow(2.0 * std::numbers::pi * Resonance{}.frequency, 2.0);
    CHECK(bodyFrequencyResponse(body, {}, 0_Hz, BodyPoint::excursion).real() == Approx(body.force / stiffness));
}

TEST_CASE("Numbers that no profile holds are clamped", "[actuator]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, infinite, -infinite, 0.0, -1.0})
    {
        const auto h = bodyFrequencyResponse({bad, bad, bad, bad, bad, bad, bad, bad}, {bad, bad}, 100_Hz);
        CHECK(std::isfinite(std::abs(h)));
    }
}
