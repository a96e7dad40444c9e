#include "SimulatedActuator.h"
#include "support/Catch.h"

#include <pacini/actuator/MovingMass.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace pacini;

TEST_CASE("A mass moved by groups of frames is where single steps and a simulation put it", "[actuator][protection]")
{
    for (const double fs : {8000.0, 48000.0, 768000.0})
        for (const double q : {0.2, 4.0, 30.0})
        {
            CAPTURE(fs, q);
            const double f = 175.0;
            const HeldStep step = designHeldStep(f, q, 1e-3, 1.0 / fs);
            const GroupStep group = designGroupStep(step);
            Random random(9);
            std::vector<double> drive(20000);
            for (double& u : drive)
                u = static_cast<double>(static_cast<float>(random.uniform(-1.0, 1.0)));

            MovingMass single;
            MovingMass grouped;
            ResonatorState plain;
            test::SimulatedResonator mass(f, q, 1e-3, fs);
            double largest = 0.0;
            for (std::size_t i = 0; i < drive.size(); i += groupFrames)
            {
                for (std::size_t k = 0; k < groupFrames; ++k)
                {
                    single.follow(drive[i + k], step, group);
                    plain = step.next(plain, drive[i + k]);
                    REQUIRE(single.state().displacement == Approx(plain.displacement).margin(1e-15));
                    REQUIRE(single.state().velocity == Approx(plain.velocity).margin(1e-15));
                    mass.hold(drive[i + k]);
                }
                grouped.followGroup(groupAt(drive, i), group);
                REQUIRE(grouped.state().displacement == single.state().displacement);
                REQUIRE(grouped.state().velocity == single.state().velocity);
                largest = std::max(largest, std::abs(mass.displacement() - grouped.state().displacement));
            }
            CHECK(largest < 1e-9);
        }
}
