#include "support/Catch.h"

#include <pacini/actuator/BodyDesign.h>
#include <pacini/actuator/OutputFilter.h>

using namespace pacini;

TEST_CASE("The inverse takes an actuator's resonance to the target's", "[actuator][body]")
{
    for (const Resonance& actuator : {Resonance{65.93, 3.969}, Resonance{175.0, 15.0}, Resonance{65.0, 0.2}})
        for (const Resonance& target : {Resonance{65.93, 0.7}, Resonance{40.0, 0.5}, Resonance{80.0, 0.1}})
        {
            const auto inverse = designPolePairInverse(actuator, target, 48000.0);
            const auto polynomial = [](const Resonance& r, double f)
            {
                const double u = f / r.frequency;
                return r.frequency * r.frequency * std::complex<double>(1.0 - u * u, u / r.q);
            };
            for (const double f : {1.0, 30.0, 66.0, 175.0, 500.0, 1000.0})
            {
                CAPTURE(actuator.frequency, actuator.q, target.frequency, target.q, f);
                const auto wanted = polynomial(actuator, f) / polynomial(target, f);
                CHECK(std::abs(inverse.response(Hertz(f), 48000.0) - wanted) < 0.01 * std::abs(wanted));
            }
            const double ratio = actuator.frequency / target.frequency;
            CHECK(std::abs(inverse.response(0_Hz, 48000.0)) == Approx(ratio * ratio).epsilon(1e-9));
            // Stable, and so is its own inverse.
            CHECK(std::abs(inverse.a2) < 1.0);
            CHECK(std::abs(inverse.b2 / inverse.b0) < 1.0);
        }
}

TEST_CASE("The zeros of the inverse fall on the poles of the body model", "[actuator][body]")
{
    for (const double fs : {8000.0, 48000.0, 384000.0})
        for (const double q : {0.3, 0.5, 4.0, 80.0})
        {
            const Resonance resonance{65.93, q};
            // A device far too heavy to move: the moving mass is on a base held still.
            BodyParams body;
            body.deviceMass = body.skinMass = 1e3;
            auto chain = makeBodyChain(body, resonance);
            chain.shape = BodyShape::skinless;
            chain.deviceMass = 1e12;
            const auto model = designBodyModel(chain, BodyPoint::movingMass, fs);
            const auto inverse = designPolePairInverse(resonance, {65.93, 0.7}, fs);
            REQUIRE(model.sections.size() == 1);
            const BodySection& s = model.sections[0];
            const double scale = 1.0 - s.a;
            CHECK(std::abs(inverse.b1 / inverse.b0 + s.a + s.d) < 1e-9 * scale);
            CHECK(std::abs(inverse.b2 / inverse.b0 - (s.a * s.d - s.b * s.c)) < 1e-9 * scale);
        }
}

TEST_CASE("The loaded resonance is where the moving mass swings most", "[actuator][body]")
{
    const Resonance resonance{65.93, 12.0};
    BodyParams body;
    const Resonance loaded = loadedResonance(body, resonance);
    double top = 0.0, largest = 0.0;
    for (double f = 40.0; f < 150.0; f += 0.05)
    {
        const double level = std::abs(bodyFrequencyResponse(body, resonance, Hertz(f), BodyPoint::excursion));
        if (level > largest)
        {
            largest = level;
            top = f;
        }
    }
    CHECK(loaded.frequency == Approx(top).epsilon(0.01));
    CHECK(loaded.frequency > resonance.frequency); // the device moves too
    body.deviceMass = 100.0;
    body.jointStiffness = 1e9;
    CHECK(loadedResonance(body, resonance).frequency == Approx(resonance.frequency).epsilon(1e-3));
    CHECK(loadedResonance(body, resonance).q == Approx(resonance.q).epsilon(1e-3));
}
