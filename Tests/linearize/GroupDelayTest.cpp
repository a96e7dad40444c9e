#include "linearize/MeasuredOn.h"
#include "support/Catch.h"

#include <pacini/actuator/BodyChain.h>
#include <pacini/linearize/GroupDelay.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

using namespace pacini;

namespace
{
SweepMeasurement measuredOn(const RigParams& rig)
{
    SweepParams sweep;
    sweep.duration = 10.0;
    sweep.levels = {-12.0};
    return test::measuredOn(rig, sweep);
}
} // namespace

TEST_CASE("The group delay of a one-pole filter is that of its phase, from any zero", "[linearize]")
{
    // h(n) = a^n from index 5 on: H = 1 / (1 - a e^-iw), delay = (a cos w - a^2) / (1 - 2 a cos w + a^2) samples.
    for (const double a : {0.3, 0.9, -0.5})
        for (const double zero : {0.0, 0.002, -0.01})
        {
            CAPTURE(a, zero);
            ImpulseResponse response{1000.0, 5, std::vector<double>(600, 0.0)};
            for (std::size_t n = 0; n + 5 < response.samples.size(); ++n)
                response.samples[n + 5] = std::pow(a, static_cast<double>(n));
            const std::vector<double> frequency{10.0, 50.0, 123.0, 250.0, 400.0};
            const auto delay = groupDelay(response, zero, frequency, 0.0);
            REQUIRE(delay.size() == frequency.size());
            for (std::size_t i = 0; i < delay.size(); ++i)
            {
                const double w = 2.0 * std::numbers::pi * frequency[i] / 1000.0;
                const double samples = (a * std::cos(w) - a * a) / (1.0 - 2.0 * a * std::cos(w) + a * a);
                CHECK(delay[i] == Approx(samples / 1000.0 - zero).margin(2e-6));
            }
        }
}

TEST_CASE("Silence has a group delay of 0, not one of rounding", "[linearize]")
{
    const ImpulseResponse silent{1000.0, 5, std::vector<double>(100, 0.0)};
    CHECK(groupDelay(silent, 0.0, std::vector<double>{10.0, 100.0}, 0.1) == std::vector<double>{0.0, 0.0});
}

TEST_CASE("A notch in the middle of a response does not throw its group delay", "[linearize]")
{
    // 1 + z^-20 has the delay of 10 samples everywhere, and no response at 25, 75, 125 ... Hz.
    ImpulseResponse response{1000.0, 0, std::vector<double>(64, 0.0)};
    response.samples[0] = response.samples[20] = 1.0;
    const auto frequency = logSpaced(20.0, 400.0, 200);
    for (const double delay : groupDelay(response, 0.0, frequency, 1.0 / 12.0))
        CHECK(delay == Approx(0.010).margin(1e-9));
}

TEST_CASE("A rig without mechanics has no group delay, whatever its latency and clock", "[linearize]")
{
    RigParams rig;
    rig.body.reset();
    rig.axes = 1;
    rig.range = 2.0;
    rig.noiseDensity = 1e-7;
    rig.bits = 0;
    rig.latency = 0.0234567;
    rig.driftPpm = 80.0;
    const auto measured = measuredOn(rig);
    REQUIRE(measured.groupDelay.size() == measured.response().size());
    for (std::size_t i = 0; i < measured.groupDelay.size(); ++i)
        if (measured.response().frequency[i] >= 20.0 && measured.response().frequency[i] <= 1200.0)
            REQUIRE(std::abs(measured.groupDelay[i]) < 2e-5);
}

TEST_CASE("A wristband's group delay is the slope of its body's phase", "[linearize]")
{
    for (const std::uint64_t seed : {1u, 2u})
    {
        CAPTURE(seed);
        RigParams rig;
        rig.seed = seed;
        const auto measured = measuredOn(rig);
        const auto body = [&](double f)
        {
            return bodyFrequencyResponse(*rig.body, rig.resonance, Hertz(f), rig.point);
        };
        // What the measurement calls the arrival lies later than the true one by what its latency is longer.
        const double later = measured.latency - rig.latency;
        double largest = 0.0;
        for (std::size_t i = 0; i < measured.groupDelay.size(); ++i)
        {
            const double f = measured.response().frequency[i];
            if (f < 60.0 || f > 1000.0) // below, the sensor's noise is near the signal
                continue;
            double sum = 0.0; // over a twelfth of an octave, by power, as it is measured
            double power = 0.0;
            for (int k = -10; k <= 10; ++k)
            {
                const double g = f * std::exp2(k / 252.0);
                const double step = 1e-3 * g;
                const double turn = std::arg(body(g + step) * std::conj(body(g - step)));
                sum -= turn / (2.0 * std::numbers::pi * 2.0 * step) * std::norm(body(g));
                power += std::norm(body(g));
            }
            largest = std::max(largest, std::abs(measured.groupDelay[i] + later - sum / power));
        }
        CHECK(largest < 3e-4);
    }
}
