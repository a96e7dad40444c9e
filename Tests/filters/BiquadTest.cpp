#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Measure.h"

#include <pacini/filters/Biquad.h>

#include <map>
#include <string>

using namespace pacini;
using namespace pacini::test;

namespace
{

const std::vector<BiquadType> allTypes{BiquadType::lowpass,  BiquadType::highpass, BiquadType::bandpass,
                                       BiquadType::notch,    BiquadType::allpass,  BiquadType::peak,
                                       BiquadType::lowShelf, BiquadType::highShelf};

/// The cookbook's analogue prototypes at s, with A = 10^(dB/40).
std::complex<long double> prototype(BiquadType type, std::complex<long double> s, long double q, long double a)
{
    const auto s2 = s * s;
    const auto over = [&](std::complex<long double> n)
    {
        return n / (s2 + s / q + 1.0L);
    };
    const long double root = std::sqrt(a);
    switch (type)
    {
    case BiquadType::lowpass:
        return over(1.0L);
    case BiquadType::highpass:
        return over(s2);
    case BiquadType::bandpass:
        return over(s / q);
    case BiquadType::notch:
        return over(s2 + 1.0L);
    case BiquadType::allpass:
        return over(s2 - s / q + 1.0L);
    case BiquadType::peak:
        return (s2 + s * (a / q) + 1.0L) / (s2 + s / (a * q) + 1.0L);
    case BiquadType::lowShelf:
        return a * (s2 + s * (root / q) + a) / (a * s2 + s * (root / q) + 1.0L);
    case BiquadType::highShelf:
        return a * (a * s2 + s * (root / q) + 1.0L) / (s2 + s * (root / q) + a);
    }
    return 0.0L;
}

} // namespace

TEST_CASE("Cookbook coefficients equal the reference", "[filters][golden]")
{
    const auto data = golden("biquads");
    const double relative = data["tol_rel"];
    const double absolute = data["tol_abs"];
    const std::map<std::string, std::pair<BiquadType, double>> kinds{
        {"lowpass", {BiquadType::lowpass, 0.0}},   {"highpass", {BiquadType::highpass, 0.0}},
        {"bandpass", {BiquadType::bandpass, 0.0}}, {"allpass", {BiquadType::allpass, 0.0}},
        {"peak_p16", {BiquadType::peak, 16.0}},    {"peak_m40", {BiquadType::peak, -40.0}},
        {"peak_0", {BiquadType::peak, 0.0}}};
    for (const auto& entry : data["cases"])
        for (const auto& [name, kind] : kinds)
        {
            const double fs = entry["fs"];
            const double f0 = entry["f0"];
            const double q = entry["Q"];
            CAPTURE(fs, f0, q, name);
            const auto c = designBiquad({kind.first, Hertz(f0), q, Decibels(kind.second)}, fs);
            const std::vector<double> found{c.b0, c.b1, c.b2, 1.0, c.a1, c.a2};
            for (std::size_t i = 0; i < found.size(); ++i)
            {
                const double expected = entry[name][i];
                CHECK(std::abs(found[i] - expected) <= relative * std::abs(expected) + absolute);
            }
        }
}

TEST_CASE("Every biquad type has its analogue prototype's response at the warped frequency", "[filters]")
{
    for (const BiquadType type : allTypes)
        for (const double ratio : {1e-6, 1e-4, 0.01, 0.2, 0.49})
            for (const double q : {0.1, 0.7, 10.0, 1e4})
                for (const double gain : {-20.0, 12.0})
                {
                    const double fs = 48000.0;
                    CAPTURE(static_cast<int>(type), ratio, q, gain);
                    const auto c = designBiquad({type, Hertz(ratio * fs), q, Decibels(gain)}, fs);
                    for (const double x : {0.1, 0.9, 1.3, 20.0})
                    {
                        const long double f = static_cast<long double>(ratio) * static_cast<long double>(x);
                        if (f >= 0.5L)
                            continue;
                        const long double pi = std::numbers::pi_v<long double>;
                        const std::complex<long double> s{0.0L, std::tan(pi * f) /
                                                                    std::tan(pi * static_cast<long double>(ratio))};
                        const auto expected = prototype(type, s, static_cast<long double>(q),
                                                        std::pow(10.0L, static_cast<long double>(gain) / 40.0L));
                        const auto found = c.response(Hertz(static_cast<double>(f) * fs), fs);
                        // A direct form in double resolves 1 + a1 + a2 = (2 pi f0/fs)^2 to about 4e-16 only.
                        const double resolution = 1e-12 + 4e-16 / std::pow(2.0 * std::numbers::pi * ratio, 2.0);
                        CHECK(std::abs(found - std::complex<double>(expected)) <
                              resolution * (1.0 + 20.0 * static_cast<double>(std::abs(expected))));
                    }
                }
}

TEST_CASE("A direct form's measured response equals response()", "[filters]")
{
    const double fs = 8000.0;
    for (const BiquadType type : allTypes)
    {
        const auto c = designBiquad({type, 300_Hz, 2.0, 9_dB}, fs);
        BiquadState state;
        std::vector<double> h(8192);
        for (std::size_t n = 0; n < h.size(); ++n)
            h[n] = state.tick(c, n == 0 ? 1.0 : 0.0);
        for (const double f : {20.0, 150.0, 300.0, 320.0, 1500.0, 3900.0})
        {
            CAPTURE(static_cast<int>(type), f);
            CHECK(std::abs(spectrumAt<double>(h, f, fs) - c.response(Hertz(f), fs)) < 1e-9);
        }
    }
}

TEST_CASE("Biquads are stable from 1e-7 to all of half the sample rate and at any Q", "[filters]")
{
    for (const BiquadType type : allTypes)
        for (const double ratio : {0.0, 1e-9, 1e-7, 1e-6, 1e-5, 1e-3, 0.1, 0.25, 0.49, 0.4999, 0.5, 3.0})
            for (const double q : {0.0, 1e-3, 0.1, 0.7, 30.0, 1e4, 1e5, 1e9})
                for (const double gain : {-500.0, -40.0, 0.0, 40.0, 500.0})
                {
                    CAPTURE(static_cast<int>(type), ratio, q, gain);
                    const auto c = designBiquad({type, Hertz(ratio * 96000.0), q, Decibels(gain)}, 96000.0);
                    // Poles strictly inside the unit circle: |a2| < 1 and |a1| < 1 + a2.
                    REQUIRE(std::abs(c.a2) < 1.0);
                    REQUIRE((1.0 - std::abs(c.a1)) + c.a2 > 0.0);
                    REQUIRE(std::isfinite(c.b0 + c.b1 + c.b2));
                }
}

TEST_CASE("Parameters that are not numbers still give a stable biquad", "[filters]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const BiquadType type : allTypes)
        for (const double bad : {nan, inf, -inf})
        {
            const auto c = designBiquad({type, Hertz(bad), bad, Decibels(bad)}, 48000.0);
            CHECK(std::isfinite(c.b0 + c.b1 + c.b2));
            CHECK(std::abs(c.a2) < 1.0);
            CHECK((1.0 - std::abs(c.a1)) + c.a2 > 0.0);
        }
}

TEST_CASE("A biquad's state keeps eight digits at a thousandth of the sample rate at any Q", "[filters]")
{
    for (const double q : {0.7, 10.0, 1e4})
    {
        const ClosedFormResponse reference(0, 1e-3L, static_cast<long double>(q));
        const auto c = designBiquad({BiquadType::lowpass, Hertz(48.0), q}, 48000.0);
        BiquadState state;
        double error = 0.0;
        double largest = 0.0;
        for (std::size_t n = 0; n < 100000; ++n)
        {
            const double expected = static_cast<double>(reference.at(n));
            error = std::max(error, std::abs(state.tick(c, n == 0 ? 1.0 : 0.0) - expected));
            largest = std::max(largest, std::abs(expected));
        }
        CAPTURE(q, error / largest);
        CHECK(error < 1e-8 * largest);
    }
}
