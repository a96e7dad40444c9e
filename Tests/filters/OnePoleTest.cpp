#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/filters/OnePole.h>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("A one-pole's measured response equals response() and the analogue one at the warped frequency", "[filters]")
{
    const double fs = 8000.0;
    for (const auto type : {OnePoleType::lowpass, OnePoleType::highpass})
    {
        OnePole filter;
        filter.setParams({type, 200_Hz});
        filter.prepare({fs, 8192});
        auto h = impulse(8192);
        filter.process(h, h);
        for (const double f : {10.0, 200.0, 1000.0, 3900.0})
        {
            const auto response = filter.coefficients().response(Hertz(f), fs);
            CHECK(std::abs(spectrumAt<float>(h, f, fs) - response) < 1e-5);
            const double ratio = std::tan(std::numbers::pi * f / fs) / std::tan(std::numbers::pi * 200.0 / fs);
            const double power =
                type == OnePoleType::lowpass ? 1.0 / (1.0 + ratio * ratio) : ratio * ratio / (1.0 + ratio * ratio);
            CHECK(std::norm(response) == Approx(power).epsilon(1e-12));
        }
    }
}

TEST_CASE("A one-pole's step follows its closed form from 1e-6 of the sample rate to 0.49", "[filters]")
{
    for (const double ratio : {1e-6, 1e-4, 0.01, 0.2, 0.49})
        for (const double fs : {8000.0, 384000.0})
        {
            OnePole filter;
            filter.setParams({OnePoleType::lowpass, Hertz(ratio * fs)});
            filter.prepare({fs, 200000});
            std::vector<float> y(200000, 1.0f);
            filter.process(y, y);
            // H(z) = g (1 + z^-1) / ((1 + g) - (1 - g) z^-1) has the step response 1 - p^n / (1 + g) with the pole
            // p = (1 - g) / (1 + g).
            const long double g = std::tan(std::numbers::pi_v<long double> * static_cast<long double>(ratio));
            const long double pole = (1.0L - g) / (1.0L + g);
            for (std::size_t n = 0; n < y.size(); n += n < 10 ? 1 : 997)
            {
                const long double expected = 1.0L - std::pow(pole, static_cast<long double>(n)) / (1.0L + g);
                CAPTURE(ratio, fs, n);
                CHECK(static_cast<double>(y[n]) == Approx(static_cast<double>(expected)).epsilon(2e-7).margin(1e-12));
            }
        }
}

TEST_CASE("OnePole keeps the contract of blocks and stays bounded while its frequency jumps", "[filters][contract]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    checkBlockContract<OnePole>({OnePoleType::lowpass, 100_Hz}, {.bound = 1.0, .delay = MeasuredDelay::firstFrame});
    checkBlockContract<OnePole>({OnePoleType::highpass, 5_Hz}, {.bound = 2.0, .delay = MeasuredDelay::firstFrame});
    checkBlockContract<OnePole>({OnePoleType::highpass, Hertz(nan)}, {.bound = 2.0});
    checkModulation<OnePole>({{OnePoleType::lowpass, 0.001_Hz},
                              {OnePoleType::lowpass, 100_Hz},
                              {OnePoleType::highpass, 3900_Hz},
                              {OnePoleType::lowpass, 1e9_Hz}},
                             100.0); // a pole next to z = -1 remembers many samples
    checkSilenceIsCheap<OnePole>({OnePoleType::highpass, 5_Hz});
    checkSilenceIsCheap<OnePole>({OnePoleType::highpass, 5_Hz}, 480000);
}
