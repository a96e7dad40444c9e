#include "cli/bench/BodyIntegration.h"

#include "actuator/BodyReference.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/actuator/BodyModel.h>

#include <array>

using namespace pacini;
using namespace pacini::cli;
using namespace pacini::test;

namespace
{
constexpr std::array integrators = {BodyIntegrator::semiImplicitEuler, BodyIntegrator::rungeKutta4,
                                    BodyIntegrator::trapezoidal, BodyIntegrator::matrixExponential};

double errorAt(BodyIntegrator integrator, const BodyChain& chain, double f, double fs)
{
    const auto wanted = chain.response(BodyPoint::skin, Hertz(f));
    return std::abs(BodyIntegration(integrator, chain, fs).response(Hertz(f)) - wanted) / std::abs(wanted);
}
} // namespace

TEST_CASE("Each integrator converges with its order", "[actuator][body]")
{
    const auto chain = makeBodyChain({}, {65.93, 3.969});
    const double orders[] = {1.0, 2.0, 2.0, 2.0}; // linear interpolation of the force is of second order
    for (std::size_t i = 0; i < integrators.size(); ++i)
    {
        CAPTURE(i);
        const double coarse = errorAt(integrators[i], chain, 200.0, 24000.0);
        const double fine = errorAt(integrators[i], chain, 200.0, 48000.0);
        CHECK(std::log2(coarse / fine) == Approx(orders[i]).margin(0.1));
        CHECK(fine < 0.02);
    }
}

TEST_CASE("An integrator's response is what it does to a signal", "[actuator][body]")
{
    const auto chain = makeBodyChain({}, {65.93, 3.969});
    for (const BodyIntegrator integrator : integrators)
    {
        BodyIntegration integration(integrator, chain, 16000.0);
        std::vector<float> h = impulse(32000, 1);
        integration.process(h, h);
        for (const double f : {40.0, 66.0, 400.0})
        {
            const auto delay = std::polar(1.0, 2.0 * std::numbers::pi * f / 16000.0);
            const auto wanted = integration.response(Hertz(f));
            CHECK(std::abs(spectrumAt<float>(h, f, 16000.0) * delay - wanted) < 1e-5 * std::abs(wanted));
        }
    }
}

TEST_CASE("Explicit integrators break at stiff joints, implicit and exact ones do not", "[actuator][body]")
{
    BodyParams body;
    body.jointStiffness = 1e10;
    setJointDampingRatio(body, 0.02);
    const auto stiff = makeBodyChain(body, {65.93, 3.969});
    const auto radius = [&](BodyIntegrator integrator)
    {
        return BodyIntegration(integrator, stiff, 48000.0).spectralRadius();
    };
    CHECK(radius(BodyIntegrator::semiImplicitEuler) > 2.0);
    CHECK(radius(BodyIntegrator::rungeKutta4) > 2.0);
    CHECK(radius(BodyIntegrator::trapezoidal) <= 1.0 + 1e-9);
    CHECK(radius(BodyIntegrator::matrixExponential) <= 1.0 + 1e-9);
}

TEST_CASE("The dense matrix exponential and the modes are the same hold", "[actuator][body]")
{
    const auto chain = makeBodyChain({}, {65.93, 3.969});
    BodyIntegration dense(BodyIntegrator::matrixExponential, chain, 48000.0);
    BodyFilter modes;
    modes.setCoefficients(designBodyModel(chain, BodyPoint::skin, 48000.0, BodyHold::linear));
    auto x = noise(4800, 3);
    auto y = x;
    dense.process(x, x);
    modes.process(y, y);
    double largest = 0.0;
    for (std::size_t n = 2; n < x.size(); ++n)
        largest = std::max(largest, std::abs(static_cast<double>(x[n - 2] - y[n])));
    CHECK(largest < 1e-5 * rms(x));
}
