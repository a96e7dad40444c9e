#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Measure.h"
#include "support/Pinned.h"

#include <pacini/linearize/Deconvolution.h>
#include <pacini/linearize/LevelAnalysis.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

using namespace pacini;

namespace
{
std::vector<double> goldenSweep(const nlohmann::json& c)
{
    return delayedSweep(ExponentialSweep(c["f1"], c["f2"], c["T"], 0.0, 0.0), c["fs"], 0.0);
}

/// The circular impulse response, so long that nothing wraps but what comes before the arrival.
std::vector<double> deconvolve(const std::vector<double>& recorded, const std::vector<double>& played)
{
    Deconvolver deconvolver(played, nextFastFftSize(recorded.size() + played.size()));
    return deconvolver.signal(deconvolver.response(deconvolver.spectrum(recorded)));
}

/// The level of a circular response at f Hz, from `before` samples of negative time on.
double levelAt(const std::vector<double>& h, double f, double fs, std::size_t before = 1000)
{
    std::vector<double> inOrder(h.end() - static_cast<std::ptrdiff_t>(before), h.end());
    inOrder.insert(inOrder.end(), h.begin(), h.end() - static_cast<std::ptrdiff_t>(before));
    return 20.0 * std::log10(std::abs(test::spectrumAt<double>(inOrder, f, fs)));
}

/// The cookbook's peak filter, sample by sample.
std::vector<double> peakFiltered(const std::vector<double>& x, double f, double gain, double q, double fs)
{
    const double a = std::pow(10.0, gain / 40.0);
    const double w = 2.0 * std::numbers::pi * f / fs;
    const double alpha = std::sin(w) / (2.0 * q);
    const double a0 = 1.0 + alpha / a;
    const double b0 = (1.0 + alpha * a) / a0;
    const double b1 = -2.0 * std::cos(w) / a0;
    const double b2 = (1.0 - alpha * a) / a0;
    const double a2 = (1.0 - alpha / a) / a0;
    std::vector<double> y(x.size());
    for (std::size_t n = 0; n < x.size(); ++n)
        y[n] = b0 * x[n] + b1 * ((n > 0 ? x[n - 1] : 0.0) - (n > 0 ? y[n - 1] : 0.0)) +
               (n > 1 ? b2 * x[n - 2] - a2 * y[n - 2] : 0.0);
    return y;
}
} // namespace

TEST_CASE("A sweep through a known filter deconvolves to that filter", "[linearize]")
{
    const auto ess = test::golden("ess");
    const auto& c = ess["cases"][0];
    const auto& expected = c["deconv_peaking_67_12dB_Q4"];
    const auto x = goldenSweep(c);
    auto padded = x;
    padded.resize(x.size() + expected["tail_zeros"].get<std::size_t>(), 0.0);
    const double fs = c["fs"];
    const auto y = peakFiltered(padded, 67.0, 12.0, 4.0, fs);
    const auto h = deconvolve(y, x);
    CHECK(std::max_element(h.begin(), h.end()) - h.begin() == expected["ir_argmax"].get<std::ptrdiff_t>());
    for (std::size_t i = 0; i < expected["freqs"].size(); ++i)
    {
        const double f = expected["freqs"][i];
        const double level = levelAt(h, f, fs);
        CHECK(level == Approx(expected["expected_db"][i].get<double>()).margin(expected["tol_db"].get<double>()));
        CHECK(level == Approx(expected["measured_db"][i].get<double>()).margin(0.005));
    }
}

TEST_CASE("A delay and a gain show in the impulse response", "[linearize]")
{
    const auto ess = test::golden("ess");
    const auto& c = ess["cases"][0];
    const auto& expected = c["delay_123_gain_0.5"];
    const auto x = goldenSweep(c);
    std::vector<double> y(x.size() + 2000, 0.0);
    for (std::size_t n = 0; n < x.size(); ++n)
        y[n + 123] = 0.5 * x[n];
    const auto h = deconvolve(y, x);
    const auto peak = std::max_element(h.begin(), h.end());
    CHECK(peak - h.begin() == expected["argmax"].get<std::ptrdiff_t>());
    CHECK(*peak == Approx(expected["peak"].get<double>()).epsilon(0.002));
}

TEST_CASE("An impulse response without its negative time loses level at the ends", "[linearize]")
{
    const auto ess = test::golden("ess");
    const auto x = goldenSweep(ess["cases"][0]);
    const auto whole = deconvolve(x, x);
    auto oneSided = whole;
    std::fill(oneSided.begin() + static_cast<std::ptrdiff_t>(oneSided.size() / 2), oneSided.end(), 0.0);
    double lost = 0.0;
    for (const double f : {30.0, 100.0, 300.0, 1000.0, 1300.0})
    {
        CHECK(std::abs(levelAt(whole, f, 8000.0)) < 0.02);
        lost = std::max(lost, std::abs(levelAt(oneSided, f, 8000.0)));
    }
    CHECK(lost > 0.3);
}

TEST_CASE("The endless sweep's spectrum is that of a long sweep", "[linearize]")
{
    const ExponentialSweep sweep(10.0, 3000.0, 10.0, 0.2, 0.1);
    const double fs = 8000.0;
    const double start = 0.0123;
    const auto x = delayedSweep(sweep, fs, start * fs);
    for (const double f : {40.0, 123.0, 500.0, 1700.0})
    {
        const auto ratio = test::spectrumAt<double>(x, f, fs) * endlessSweepInverse(f, sweep, fs, start);
        CHECK(std::abs(ratio - 1.0) < 0.01);
    }
}

TEST_CASE("A deconvolver's spectra are those of its definition", "[linearize]")
{
    const std::vector<double> played{1.0, -0.5, 0.25, 2.0, 0.0, -1.5};
    const std::vector<double> recorded{0.5, 3.0, -1.0, 0.75, 0.2, 0.0, 1.0};
    for (const double regularisation : {-60.0, -20.0})
    {
        Deconvolver deconvolver(played, 8, regularisation);
        CHECK(deconvolver.size() == 8);
        double largest = 0.0;
        for (int k = 0; k <= 4; ++k)
            largest = std::max(largest, std::norm(test::spectrumAt<double>(played, k, 8.0)));
        const auto spectrum = deconvolver.spectrum(recorded);
        const auto response = deconvolver.response(spectrum);
        REQUIRE(response.re.size() == 5);
        for (int k = 0; k <= 4; ++k)
        {
            const auto x = test::spectrumAt<double>(played, k, 8.0);
            const auto y = test::spectrumAt<double>(recorded, k, 8.0);
            const auto inverse = std::conj(x) / (std::norm(x) + largest * std::pow(10.0, regularisation / 10.0));
            const auto i = static_cast<std::size_t>(k);
            CHECK(spectrum.re[i] == Approx(y.real()).margin(1e-12));
            CHECK(spectrum.im[i] == Approx(y.imag()).margin(1e-12));
            CHECK(response.re[i] == Approx((y * inverse).real()).margin(1e-12));
            CHECK(response.im[i] == Approx((y * inverse).imag()).margin(1e-12));
            CHECK(deconvolver.noisePower(k / 8.0) == Approx(std::norm(inverse)));
            CHECK(deconvolver.noisePower((k + 0.4) / 8.0) == Approx(std::norm(inverse)));
        }
        CHECK(deconvolver.noisePower(3.0) == deconvolver.noisePower(0.5));
        // there and back
        const auto back = deconvolver.signal(spectrum);
        for (std::size_t n = 0; n < 8; ++n)
            CHECK(back[n] == Approx(n < 7 ? recorded[n] : 0.0).margin(1e-12));
    }
    // by default 60 dB down, and nothing played gives nothing
    Deconvolver usual(played, 8), sixty(played, 8, -60.0), silent(std::vector<double>(4, 0.0), 8);
    CHECK(usual.noisePower(0.25) == sixty.noisePower(0.25));
    CHECK(silent.noisePower(0.25) == 0.0);
}

TEST_CASE("A delayed sweep begins that many samples later and lasts to its end", "[linearize]")
{
    const ExponentialSweep sweep(20.0, 400.0, 0.5, 0.0, 0.0);
    const auto x = delayedSweep(sweep, 1000.0, 2.25);
    REQUIRE(x.size() == 503);
    for (std::size_t n = 0; n < x.size(); ++n)
        CHECK(x[n] == sweep.at((static_cast<double>(n) - 2.25) / 1000.0));
    CHECK(delayedSweep(sweep, 1000.0, -100.0).size() == 400);
    CHECK(delayedSweep(sweep, 1000.0, -100.0)[0] == sweep.at(0.1));
    CHECK(delayedSweep(sweep, 1000.0, -600.0).empty());
}
