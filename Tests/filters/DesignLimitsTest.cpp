#include "support/Catch.h"

#include <pacini/filters/BandLayout.h>
#include <pacini/filters/Biquad.h>
#include <pacini/filters/Butterworth.h>
#include <pacini/filters/DesignLimits.h>
#include <pacini/filters/FilterBank.h>
#include <pacini/filters/RationalDecimator.h>
#include <pacini/filters/Resampler.h>
#include <pacini/filters/StateVariable.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
bool alike(double a, double b)
{
    return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

bool alike(const BiquadCoefficients& a, const BiquadCoefficients& b)
{
    return alike(a.b0, b.b0) && alike(a.b1, b.b1) && alike(a.b2, b.b2) && alike(a.a1, b.a1) && alike(a.a2, b.a2);
}

bool alike(const StateVariableCoefficients& a, const StateVariableCoefficients& b)
{
    return alike(a.loop.g, b.loop.g) && alike(a.loop.k, b.loop.k) && alike(a.high, b.high) && alike(a.band, b.band) &&
           alike(a.low, b.low);
}

bool alike(const BiquadCascadeCoefficients& a, const BiquadCascadeCoefficients& b)
{
    return std::equal(a.sections.begin(), a.sections.end(), b.sections.begin(), b.sections.end(),
                      [](const auto& x, const auto& y) { return alike(x, y); });
}
} // namespace

TEST_CASE("Filters are designed within their limits, and at the lower one for what is no number", "[filters]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double fs = 50000.0;
    CHECK(clampedFrequency(1000_Hz, fs) == 1000.0);
    CHECK(alike(clampedFrequency(0_Hz, fs), 1e-7 * fs));
    CHECK(alike(clampedFrequency(Hertz(nan), fs), 1e-7 * fs));
    CHECK(alike(clampedFrequency(1_kHz, 1000.0), 499.9));
    CHECK(clampedQ(3.0) == 3.0);
    CHECK(clampedQ(0.0) == 1e-6);
    CHECK(clampedQ(1e9) == 1e5);
    CHECK(clampedQ(nan) == 1e-6);
    CHECK(clampedGain(5_dB).value == 5.0);
    CHECK(clampedGain(500_dB).value == 120.0);
    CHECK(clampedGain(Decibels(-500.0)).value == -120.0);
    CHECK(clampedGain(Decibels(nan)).value == -120.0);
    for (const BiquadType type : {BiquadType::lowpass, BiquadType::peak, BiquadType::highShelf})
    {
        const BiquadParams beyond{type, Hertz(1e9), 1e9, Decibels(1e3)};
        const BiquadParams at{type, Hertz(0.4999 * fs), 1e5, Decibels(120.0)};
        CHECK(alike(designBiquad(beyond, fs), designBiquad(at, fs)));
        CHECK(alike(designStateVariable(beyond, fs), designStateVariable(at, fs)));
        const BiquadParams below{type, Hertz(-1.0), -1.0, Decibels(-1e3)};
        const BiquadParams lowest{type, Hertz(1e-7 * fs), 1e-6, Decibels(-120.0)};
        CHECK(alike(designBiquad(below, fs), designBiquad(lowest, fs)));
        CHECK(alike(designStateVariable(below, fs), designStateVariable(lowest, fs)));
    }
}

TEST_CASE("Parameters of filters begin with what is documented", "[filters]")
{
    const BiquadParams section;
    CHECK(section.type == BiquadType::lowpass);
    CHECK(section.frequency == 1000_Hz);
    CHECK(section.q == Approx(1.0 / std::numbers::sqrt2).epsilon(1e-15));
    CHECK(section.gain == 0_dB);
    const ButterworthParams butterworth;
    CHECK(butterworth.type == ButterworthType::lowpass);
    CHECK(butterworth.order == 2);
    CHECK(butterworth.frequency == 1000_Hz);
    CHECK(butterworth.highFrequency == 2000_Hz);
    CHECK(maxButterworthOrder == 16);
    CHECK(maxBiquadSections == 32);
    CHECK(maxBands == 32);
    const BandLayoutParams layout;
    CHECK(layout.bands == 6);
    CHECK(layout.low == 30_Hz);
    CHECK(layout.high == 1000_Hz);
    CHECK(layout.spacing == BandSpacing::logarithmic);
    CHECK(layout.kind == BandLayoutKind::centresAtEnds);
    const RationalDecimatorParams decimator;
    CHECK(decimator.passFrequency == 1700_Hz);
    CHECK(decimator.stopFrequency == 2600_Hz);
    CHECK(decimator.attenuation == 60_dB);
    CHECK(lowestResamplerRate == 2000);
    CHECK(highestResamplerRate == 768000);
    CHECK(FilterBank{}.coefficients() == designFilterBank({}, 48000.0));
    CHECK(Butterworth{}.coefficients() == designButterworth({}, 48000.0));
}

TEST_CASE("Sections as constructed: polynomials pass everything, integrators stand still", "[filters]")
{
    const BiquadCoefficients through;
    CHECK(through == BiquadCoefficients{1.0, 0.0, 0.0, 0.0, 0.0});
    BiquadState state;
    for (const double x : {0.3, -1.0, 2.0})
        CHECK(state.tick(through, x) == x);
    CHECK(StateVariableLoop{} == StateVariableLoop::make(0.0, 1.0));
    CHECK(StateVariableCoefficients{} == StateVariableCoefficients::make(StateVariableLoop{}, 0.0, 0.0, 0.0));
    StateVariableState still;
    CHECK(still.s1 == 0.0);
    CHECK(still.s2 == 0.0);
    still = {1e-101, 1e-99};
    still.flush();
    CHECK(still.s1 == 0.0);
    CHECK(still.s2 == 1e-99);
    still = {1e-99, -1e-101};
    still.flush();
    CHECK(still.s1 == 1e-99);
    CHECK(still.s2 == 0.0);
}

TEST_CASE("A band-pass of no width is as narrow as is allowed, and a band-pass ends below half the rate", "[filters]")
{
    const double fs = 48000.0;
    const auto bandpass = [&](double low, double high)
    {
        return designButterworth({ButterworthType::bandpass, 3, Hertz(low), Hertz(high)}, fs);
    };
    CHECK(alike(bandpass(1000.0, 500.0), bandpass(1000.0, 1000.0 * (1.0 + 1e-4))));
    CHECK(alike(bandpass(1000.0, 1000.0), bandpass(1000.0, 1000.0 * (1.0 + 1e-4))));
    CHECK_FALSE(alike(bandpass(1000.0, 1000.2), bandpass(1000.0, 1000.0)));
    CHECK(alike(bandpass(1000.0, 1e6), bandpass(1000.0, 0.4999 * fs)));
    CHECK(alike(bandpass(1e6, 1e6), bandpass(0.4999 * fs / (1.0 + 1e-4), 0.4999 * fs)));
    CHECK(alike(bandpass(-5.0, 100.0), bandpass(1e-7 * fs, 100.0)));
    CHECK(designButterworth({ButterworthType::bandpass, 99, 100_Hz, 200_Hz}, fs).sections.size() == 16);
    CHECK(designButterworth({ButterworthType::lowpass, 99, 100_Hz, 200_Hz}, fs).sections.size() == 8);
    CHECK(designButterworth({ButterworthType::highpass, 0, 100_Hz, 200_Hz}, fs).sections.size() == 1);
    // Sections of low quality come first.
    for (const auto type : {ButterworthType::lowpass, ButterworthType::highpass, ButterworthType::bandpass})
        for (const int order : {5, 8})
        {
            const auto sections = designButterworth({type, order, 100_Hz, 300_Hz}, fs).sections;
            for (std::size_t i = 0; i + 1 < sections.size(); ++i)
                CHECK(sections[i].loop.k >= sections[i + 1].loop.k * (1.0 - 1e-12));
        }
    // The quality of the prototype's pole pairs: order 4 has 0.541 and 1.307.
    const auto four = designButterworth({ButterworthType::lowpass, 4, 100_Hz, 0_Hz}, fs).sections;
    CHECK(1.0 / four[0].loop.k == Approx(0.541196100146197).epsilon(1e-12));
    CHECK(1.0 / four[1].loop.k == Approx(1.306562964876377).epsilon(1e-12));
}

TEST_CASE("Band layouts keep to their limits, and a single band to the middle of its range", "[filters]")
{
    const auto layout =
        [](double low, double high, std::size_t bands = 2, BandSpacing spacing = BandSpacing::logarithmic)
    {
        return designBandLayout({bands, Hertz(low), Hertz(high), spacing, BandLayoutKind::centresAtEnds});
    };
    CHECK(layout(0.2, 100.0).centres[0].value == 1.0);
    CHECK(layout(1.0, 100.0).centres[0].value == 1.0);
    CHECK(layout(3e6, 1.0).centres[0].value == 1e6);
    CHECK(layout(100.0, 50.0).centres[1].value == Approx(100.1).epsilon(1e-12));
    CHECK(layout(100.0, 1e9).centres[1].value == Approx(2e6).epsilon(1e-12));
    CHECK(layout(100.0, 200.0, 0).bands() == 1);
    CHECK(layout(100.0, 200.0, 33).bands() == 32);
    const auto one = layout(100.0, 400.0, 1);
    REQUIRE(one.bands() == 1);
    CHECK(one.crossovers.empty());
    CHECK(one.centres[0].value == Approx(200.0).epsilon(1e-12));
    CHECK(one.lowerEdge(0).value == Approx(100.0).epsilon(1e-12));
    CHECK(one.upperEdge(0).value == Approx(400.0).epsilon(1e-12));
    const auto plain = layout(100.0, 400.0, 1, BandSpacing::linear);
    CHECK(plain.spacing == BandSpacing::linear);
    CHECK(plain.centres[0].value == 250.0);
    CHECK(plain.lowerEdge(0).value == 125.0);
    CHECK(plain.upperEdge(0).value == 500.0);
    // Mirrored edges on the logarithmic scale; on the linear one they end at 0.
    const auto three = layout(100.0, 400.0, 3);
    CHECK(three.lowerEdge(0).value == Approx(100.0 / std::numbers::sqrt2).epsilon(1e-12));
    CHECK(three.upperEdge(2).value == Approx(400.0 * std::numbers::sqrt2).epsilon(1e-12));
    CHECK(three.upperEdge(0) == three.lowerEdge(1));
    CHECK(three.upperEdge(1) == three.lowerEdge(2));
    CHECK(layout(10.0, 1010.0, 3, BandSpacing::linear).lowerEdge(0).value == 0.0);
    // Two bands with cutoffs at their ends are two with centres there.
    BandLayoutParams two{2, 100_Hz, 400_Hz, BandSpacing::logarithmic, BandLayoutKind::cutoffsAtEnds};
    CHECK(designBandLayout(two).centres[0].value == Approx(100.0).epsilon(1e-12));
    CHECK(designBandLayout(two).centres[1].value == Approx(400.0).epsilon(1e-12));
}
