#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/filters/Biquad.h>
#include <pacini/filters/StateVariable.h>
#include <pacini/foundation/Random.h>

using namespace pacini;
using namespace pacini::test;

namespace
{

const std::vector<BiquadType> types{BiquadType::lowpass,  BiquadType::highpass, BiquadType::bandpass,
                                    BiquadType::notch,    BiquadType::allpass,  BiquadType::peak,
                                    BiquadType::lowShelf, BiquadType::highShelf};

} // namespace

TEST_CASE("A state-variable filter has the response of the cookbook's biquad", "[filters]")
{
    for (const BiquadType type : types)
        for (const double ratio : {1e-3, 0.05, 0.3, 0.49})
            for (const double q : {0.1, 0.7, 30.0})
                for (const double f : {10.0, 900.0, 15000.0, 23000.0})
                {
                    const double fs = 48000.0;
                    CAPTURE(static_cast<int>(type), ratio, q, f);
                    const auto a = designStateVariable({type, Hertz(ratio * fs), q, Decibels(-12.0)}, fs);
                    const auto b = designBiquad({type, Hertz(ratio * fs), q, Decibels(-12.0)}, fs);
                    const auto expected = b.response(Hertz(f), fs);
                    CHECK(std::abs(a.response(Hertz(f), fs) - expected) < 1e-9 * (1.0 + std::abs(expected)));
                    const auto direct = a.directForm();
                    CHECK(std::abs(direct.response(Hertz(f), fs) - expected) < 1e-9 * (1.0 + std::abs(expected)));
                }
}

TEST_CASE("A state-variable filter's measured response equals response()", "[filters]")
{
    const double fs = 8000.0;
    for (const BiquadType type : types)
    {
        StateVariable filter;
        filter.setParams({type, 300_Hz, 2.0, 9_dB});
        filter.prepare({fs, 8192});
        auto h = impulse(8192);
        filter.process(h, h);
        for (const double f : {20.0, 150.0, 300.0, 320.0, 1500.0, 3900.0})
            CHECK(std::abs(spectrumAt<float>(h, f, fs) - filter.coefficients().response(Hertz(f), fs)) < 1e-5);
    }
}

TEST_CASE("A state-variable filter follows the closed form from 1e-6 to 0.49 of the sample rate at Q up to 1e4",
          "[filters][stability]")
{
    const std::vector<std::pair<BiquadType, int>> orders{
        {BiquadType::lowpass, 0}, {BiquadType::bandpass, 1}, {BiquadType::highpass, 2}};
    double worst = 0.0;
    for (const auto& [type, order] : orders)
        for (const double ratio : {1e-6, 1e-5, 1e-3, 0.1, 0.25, 0.49})
            for (const double q : {0.6, 10.0, 1e4})
            {
                const ClosedFormResponse reference(order, static_cast<long double>(ratio), static_cast<long double>(q));
                const double fs = 768000.0;
                const auto filter = designStateVariable({type, Hertz(ratio * fs), q}, fs);
                StateVariableState state;
                const std::size_t frames = ratio < 1e-5 ? 2000000 : 200000;
                double error = 0.0;
                double largest = 0.0;
                for (std::size_t n = 0; n < frames; ++n)
                {
                    const double x = n == 0 ? 1.0 : 0.0;
                    const double y = state.tick(filter, x);
                    if (n > 100 && n % 97 != 0)
                        continue;
                    const double expected = static_cast<double>(reference.at(n));
                    error = std::max(error, std::abs(y - expected));
                    largest = std::max(largest, std::abs(expected));
                }
                CAPTURE(static_cast<int>(type), ratio, q, error, largest);
                CHECK(error < 1e-9 * largest);
                worst = std::max(worst, error / largest);
            }
    INFO(worst);
    CHECK(worst > 0.0);
}

TEST_CASE("The state of a state-variable filter cannot grow without input, however its parameters jump",
          "[filters][stability]")
{
    Random random(9);
    StateVariableState state{1.0, -0.5};
    double energy = state.s1 * state.s1 + state.s2 * state.s2;
    for (int n = 0; n < 200000 && energy > 1e-250; ++n)
    {
        const double ratio = std::pow(10.0, random.uniform(-6.0, std::log10(0.49)));
        const double q = std::pow(10.0, random.uniform(-1.0, 4.0));
        state.tick(designStateVariable({BiquadType::lowpass, Hertz(ratio), q}, 1.0).loop, 0.0);
        const double now = state.s1 * state.s1 + state.s2 * state.s2;
        REQUIRE(now <= energy * (1.0 + 1e-12));
        energy = now;
    }
}

TEST_CASE("StateVariable keeps the contract of blocks and stays bounded while its parameters jump",
          "[filters][contract][stability]")
{
    for (const BiquadType type : types)
    {
        checkBlockContract<StateVariable>({type, 68_Hz, 1.6, Decibels(-10.0)}, {.delay = MeasuredDelay::firstFrame});
        checkBlockContract<StateVariable>({type, 3900_Hz, 1e4, 40_dB});
        checkBlockContract<StateVariable>({type, 0.001_Hz, 1e4, 40_dB});
        std::vector<BiquadParams> extremes;
        for (const double f : {0.001, 5.0, 3000.0, 1e9})
            for (const double q : {0.01, 0.7, 1e4})
                extremes.push_back({type, Hertz(f), q, 12_dB});
        checkModulation<StateVariable>(extremes, 1e6);
        checkSilenceIsCheap<StateVariable>({type, 5_Hz, 0.7, 6_dB});
        checkSilenceIsCheap<StateVariable>({type, 5_Hz, 0.7, 6_dB}, 480000);
    }
}

TEST_CASE("Polynomials and state-variable form answer alike", "[filters]")
{
    Random random(17);
    for (int i = 0; i < 300; ++i)
    {
        BiquadParams params;
        params.type = static_cast<BiquadType>(i % 8);
        params.frequency = Hertz(std::pow(10.0, random.uniform(1.0, 4.2)));
        params.q = std::pow(10.0, random.uniform(-1.0, 2.0));
        params.gain = Decibels(random.uniform(-24.0, 24.0));
        const BiquadCoefficients polynomials = designBiquad(params, 48000.0);
        const StateVariableCoefficients section = asStateVariable(polynomials);
        for (double f = 15.0; f < 20000.0; f *= 1.7)
        {
            const auto wanted = polynomials.response(Hertz(f), 48000.0);
            CAPTURE(i, f);
            REQUIRE(std::abs(section.response(Hertz(f), 48000.0) - wanted) < 1e-6 * (1.0 + std::abs(wanted)));
        }
    }
}
