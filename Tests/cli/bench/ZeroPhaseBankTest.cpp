#include "cli/bench/ZeroPhaseBank.h"

#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Measure.h"

#include <algorithm>
#include <cfenv>

using namespace pacini;
using namespace pacini::cli;
using namespace pacini::test;

namespace
{

const std::vector<ZeroPhaseMethod> methods{ZeroPhaseMethod::raisedCosine, ZeroPhaseMethod::forwardBackward};

ZeroPhaseBankParams withBands(std::size_t n, ZeroPhaseMethod method)
{
    ZeroPhaseBankParams params;
    params.layout.bands = n;
    params.method = method;
    return params;
}

// The gain of band k at f of the forward-backward tree at the sample rate fs (Hz): at crossover j the squared
// magnitude of a second-order Butterworth low-pass, and what that leaves. Sums to 1.
double forwardBackwardWeight(const BandLayout& layout, std::size_t k, Hertz f, double fs) noexcept
{
    double rest = 1.0;
    for (std::size_t j = 0; j < layout.crossovers.size() && j <= k; ++j)
    {
        const double ratio = std::tan(std::numbers::pi * f.value / fs) /
                             std::tan(std::numbers::pi * clampedFrequency(layout.crossovers[j], fs) / fs);
        const double fourth = ratio * ratio * ratio * ratio;
        const double low = std::isinf(fourth) ? 0.0 : 1.0 / (1.0 + fourth);
        rest *= j == k ? low : 1.0 - low;
    }
    return rest;
}

double weight(const BandLayout& layout, ZeroPhaseMethod method, std::size_t k, double f, double fs)
{
    return method == ZeroPhaseMethod::raisedCosine ? raisedCosineWeight(layout, k, Hertz(f))
                                                   : forwardBackwardWeight(layout, k, Hertz(f), fs);
}

} // namespace

TEST_CASE("Zero-phase weights equal the reference", "[filters][golden]")
{
    const auto data = golden("filterbank");
    int compared = 0;
    for (const auto& entry : data["cases"])
    {
        if (entry["design"] == "lr4")
            continue;
        const auto method = entry["design"] == "rc" ? ZeroPhaseMethod::raisedCosine : ZeroPhaseMethod::forwardBackward;
        const std::size_t n = entry["n"];
        const auto layout = designBandLayout(withBands(n, method).layout);
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t i = 0; i < data["freqs"].size(); ++i)
            {
                const double f = data["freqs"][i];
                const double expected = entry["mag"][k][i];
                CAPTURE(n, k, f);
                CHECK(weight(layout, method, k, f, entry["fs"]) ==
                      Approx(expected).epsilon(data["tol_rel"].get<double>()).margin(1e-12));
            }
        ++compared;
    }
    CHECK(compared == 11);
}

TEST_CASE("Zero-phase weights sum to 1 from 0 Hz to half the sample rate", "[filters]")
{
    for (const auto method : methods)
        for (const std::size_t n : {1u, 2u, 6u, 32u})
            for (const auto kind :
                 {BandLayoutKind::centresAtEnds, BandLayoutKind::cutoffsAtEnds, BandLayoutKind::tiled})
                for (const auto spacing : {BandSpacing::logarithmic, BandSpacing::linear})
                {
                    const auto layout = designBandLayout({n, 30_Hz, 1000_Hz, spacing, kind});
                    for (const double f : {0.0, 1.0, 30.0, 99.0, 444.0, 1000.0, 1999.0, 2000.0})
                    {
                        double sum = 0.0;
                        for (std::size_t k = 0; k < n; ++k)
                            sum += weight(layout, method, k, f, 4000.0);
                        CHECK(sum == Approx(1.0).epsilon(1e-12));
                    }
                }
}

TEST_CASE("Zero-phase bands have their weights as measured spectra and no phase", "[filters]")
{
    const double fs = 4000.0;
    const std::size_t middle = 16384;
    const auto x = impulse(2 * middle + 1, middle);
    for (const auto method : methods)
        for (const std::size_t n : {1u, 2u, 3u, 6u, 9u})
        {
            const auto params = withBands(n, method);
            const auto layout = designBandLayout(params.layout);
            const auto bands = splitZeroPhase(x, fs, params);
            REQUIRE(bands.size() == n);
            for (std::size_t k = 0; k < n; ++k)
                for (const double f : {10.0, 31.0, 50.0, 150.0, 420.0, 1200.0, 1900.0})
                {
                    CAPTURE(static_cast<int>(method), n, k, f);
                    const auto delay = std::polar(1.0, 2.0 * std::numbers::pi * f * static_cast<double>(middle) / fs);
                    const auto measured = spectrumAt<float>(bands[k], f, fs) * delay;
                    CHECK(std::abs(measured - weight(layout, method, k, f, fs)) < 2e-4);
                }
        }
}

TEST_CASE("Zero-phase bands sum to the signal, whatever its length", "[filters]")
{
    const auto check = [](ZeroPhaseMethod method, std::size_t n, std::size_t frames, double fs)
    {
        CAPTURE(static_cast<int>(method), n, frames, fs);
        const auto x = noise(frames, frames + 1);
        const auto bands = splitZeroPhase(x, fs, withBands(n, method));
        REQUIRE(bands.size() == n);
        double worst = 0.0;
        for (std::size_t i = 0; i < frames; ++i)
        {
            double sum = 0.0;
            for (const auto& band : bands)
                sum += static_cast<double>(band[i]);
            worst = std::max(worst, std::abs(sum - static_cast<double>(x[i])));
        }
        CHECK(worst < 2e-6);
    };
    for (const auto method : methods)
        for (const std::size_t n : {1u, 2u, 6u, 32u})
            for (const std::size_t frames : {0u, 1u, 2u, 3u, 4001u})
                check(method, n, frames, 8000.0);
    for (const auto method : methods)
        for (const std::size_t frames : {0u, 1u, 4001u})
            check(method, 3, frames, 384000.0);
}

TEST_CASE("A tone between two centres keeps its timing in both zero-phase bands", "[filters]")
{
    const double fs = 4000.0;
    const double f = 85.8983612;
    const auto x = sine(16000, f, fs);
    for (const auto method : methods)
    {
        const auto params = withBands(6, method);
        const auto layout = designBandLayout(params.layout);
        const auto bands = splitZeroPhase(x, fs, params);
        for (std::size_t k = 0; k < 6; ++k)
            for (std::size_t i = 6000; i < 10000; ++i)
                REQUIRE(std::abs(static_cast<double>(bands[k][i]) -
                                 weight(layout, method, k, f, fs) * static_cast<double>(x[i])) < 1e-4);
    }
}

TEST_CASE("A long signal in segments has the bands of one transform", "[filters]")
{
    // 1.2 million samples are two segments; the same around the joint as one shorter signal.
    const double fs = 4000.0;
    const auto x = noise((std::size_t{1} << 20) + 200000, 5);
    const auto params = withBands(6, ZeroPhaseMethod::raisedCosine);
    const auto whole = splitZeroPhase(x, fs, params);
    const std::size_t begin = (std::size_t{1} << 20) - 150000;
    const auto part = splitZeroPhase(std::span(x).subspan(begin, 300000), fs, params);
    for (std::size_t k = 0; k < 6; ++k)
        for (std::size_t i = 50000; i < 250000; ++i)
            REQUIRE(std::abs(static_cast<double>(whole[k][begin + i] - part[k][i])) < 1e-4);
}

TEST_CASE("A minute of silence after a sound does not make the forward-backward bank compute with denormals",
          "[filters]")
{
    auto x = noise(480000, 2);
    std::fill(x.begin() + 500, x.end(), 0.0f);
    std::feclearexcept(FE_UNDERFLOW);
    const auto bands = splitZeroPhase(x, 8000.0, withBands(6, ZeroPhaseMethod::forwardBackward));
    CHECK(std::fetestexcept(FE_UNDERFLOW) == 0);
    CHECK(bands[0].back() == 0.0f);
}

TEST_CASE("Silence stays silent and bad samples count as 0 in zero-phase banks", "[filters]")
{
    for (const auto method : methods)
    {
        for (const auto& band : splitZeroPhase(std::vector<float>(500, 0.0f), 8000.0, withBands(6, method)))
            CHECK(band == std::vector<float>(500, 0.0f));
        auto bad = noise(500, 6);
        auto zero = bad;
        bad[100] = std::numeric_limits<float>::quiet_NaN();
        bad[101] = -std::numeric_limits<float>::infinity();
        zero[100] = zero[101] = 0.0f;
        CHECK(splitZeroPhase(bad, 8000.0, withBands(6, method)) == splitZeroPhase(zero, 8000.0, withBands(6, method)));
    }
}
