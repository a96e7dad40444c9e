#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/foundation/Gaussian.h>
#include <pacini/linearize/ResponseFeatures.h>
#include <pacini/linearize/ResponseSmoothing.h>
#include <pacini/linearize/SimulatedRig.h>

#include <cmath>
#include <complex>
#include <limits>

using namespace pacini;

namespace
{
/// The level of a driven mass by its transfer function s^slope / (s^2 + w0 s / Q + w0^2), in units of w0.
double secondOrder(double f, double f0, double q, int slope)
{
    const std::complex<double> s(0.0, f / f0);
    return 20.0 * std::log10(std::abs(std::pow(s, slope) / (s * s + s / q + 1.0)));
}

/// A fine response, smoothed by brute force, with noise.
FrequencyResponse resonant(double f0, double q, int slope, double octaves, double noise, std::uint64_t seed)
{
    Gaussian gaussian(seed);
    FrequencyResponse response{logSpaced(10.0, 1500.0, 240), {}};
    for (const double f : response.frequency)
    {
        double power = 0.0;
        constexpr int pieces = 400;
        for (int i = 0; i < pieces; ++i)
            power +=
                std::pow(10.0, secondOrder(f * std::exp2(octaves * ((i + 0.5) / pieces - 0.5)), f0, q, slope) / 10.0);
        response.level.push_back(12.0 + 10.0 * std::log10(power / pieces) + noise * gaussian.next());
    }
    return response;
}
} // namespace

TEST_CASE("Resonance and Q of any actuator are found under smoothing and noise", "[linearize]")
{
    Random random(11);
    double worstFrequency = 0.0;
    double worstQ = 0.0;
    for (int i = 0; i < 60; ++i)
    {
        const double f0 = 40.0 * std::exp2(random.uniform(0.0, 2.8));
        const double q = 0.7 * std::pow(40.0 / 0.7, random.uniform());
        const int slope = i % 3 == 0 ? 1 : 2;
        const double octaves = i % 2 == 0 ? 1.0 / 12.0 : 0.0;
        CAPTURE(f0, q, slope, octaves);
        const auto response = resonant(f0, q, slope, octaves, 0.1, static_cast<std::uint64_t>(i));
        const auto found = fitResonance(response, 10.0, 1500.0, octaves).value();
        worstFrequency = std::max(worstFrequency, std::abs(found.frequency / f0 - 1.0));
        worstQ = std::max(worstQ, std::abs(found.q / q - 1.0));
        CHECK(found.frequency == Approx(f0).epsilon(0.01));
        CHECK(found.q == Approx(q).epsilon(0.05));
        CHECK(found.slope == slope);
        CHECK(found.error < 0.15);
    }
    CHECK(worstFrequency < 0.005);
    CHECK(worstQ < 0.04);
}

TEST_CASE("The ranges of a response are those of its curve", "[linearize]")
{
    // Plateau of 12 dB; a peak of 4 at 67 Hz. +3 dB is passed above the peak, -20 dB re the peak below it.
    const auto response = resonant(67.0, 4.0, 2, 0.0, 0.0, 1);
    ResponseFeatureParams params;
    params.smoothing = 0.0;
    const auto features = responseFeatures(response, params).value();
    CHECK(features.resonance.frequency == Approx(67.0).epsilon(0.001));
    CHECK(features.plateau == Approx(12.0).margin(0.6));
    CHECK(features.even.high == 1500.0);
    CHECK(secondOrder(features.even.low, 67.0, 4.0, 2) + 12.0 == Approx(features.plateau + 3.0).margin(0.2));
    const double peak = 20.0 * std::log10(4.0) + 12.0;
    CHECK(secondOrder(features.felt.low, 67.0, 4.0, 2) + 12.0 == Approx(peak - 20.0).margin(0.6));
    CHECK(features.felt.high == 1500.0);

    params.threshold = FrequencyResponse{logSpaced(10.0, 1500.0, 8), std::vector<double>(8, 14.0)};
    const auto limited = responseFeatures(response, params).value();
    CHECK(limited.felt.high < limited.even.low * 1.3);
    CHECK(secondOrder(limited.felt.high, 67.0, 4.0, 2) + 12.0 == Approx(14.0).margin(0.3));
    params.threshold->level.assign(8, 60.0);
    const auto none = responseFeatures(response, params).value();
    CHECK(none.felt.high <= none.felt.low);
}

TEST_CASE("Rise and fall of a burst follow from the impulse response", "[linearize]")
{
    const double fs = 4000.0;
    for (const double q : {2.0, 3.97, 15.0})
    {
        CAPTURE(q);
        // The impulse response of a resonator in closed form, 200 samples after the list's beginning.
        const double f0 = 67.0;
        const double w0 = 2.0 * std::numbers::pi * f0;
        const double wd = w0 * std::sqrt(1.0 - 0.25 / (q * q));
        ImpulseResponse response{fs, 200, std::vector<double>(200, 0.0)};
        for (int n = 0; n < 4000; ++n)
        {
            const double t = n / fs;
            response.samples.push_back(std::exp(-0.5 * w0 * t / q) * std::sin(wd * t) * w0 / fs);
        }
        const auto times = burstTimes(response, f0).value();
        // Driven at w0 from rest: the envelope comes within a tenth when exp(-w0 t / 2 Q) has fallen to a tenth.
        const double expected = std::log(10.0) * q / (std::numbers::pi * f0);
        CHECK(times.riseTime == Approx(expected).margin(0.6 / f0));
        CHECK(times.fallTime == Approx(expected).margin(0.6 / f0));

        // A real burst, played out: the last zero-free half cycle above 10 % ends there.
        const std::size_t burst = 3000;
        std::vector<double> y(4000, 0.0);
        const std::vector<double> h(response.samples.begin() + 200, response.samples.begin() + 1700);
        for (std::size_t n = 0; n < y.size(); ++n)
            for (std::size_t k = n < burst ? 0 : n - burst + 1; k <= std::min(n, h.size() - 1); ++k)
                y[n] += h[k] * std::sin(w0 * static_cast<double>(n - k) / fs);
        double steady = 0.0;
        for (std::size_t n = 2200; n < burst; ++n)
            steady = std::max(steady, std::abs(y[n]));
        std::size_t rise = 0;
        while (std::abs(y[rise]) < 0.9 * steady)
            ++rise;
        std::size_t fall = y.size() - 1;
        while (std::abs(y[fall]) < 0.1 * steady)
            --fall;
        CHECK(times.riseTime == Approx(static_cast<double>(rise) / fs).margin(0.6 / f0));
        CHECK(times.fallTime == Approx(static_cast<double>(fall - burst) / fs).margin(0.6 / f0));
    }
}

TEST_CASE("Features of nothing are errors that say why", "[linearize]")
{
    const auto good = resonant(67.0, 4.0, 2, 0.0, 0.0, 1);
    CHECK(fitResonance(good, 100.0, 101.0).error().where == "points");
    auto bad = good;
    bad.level[9] = std::numeric_limits<double>::infinity();
    CHECK(responseFeatures(bad).error().where == "points[9].level");
    ResponseFeatureParams params;
    params.threshold = FrequencyResponse{};
    CHECK(responseFeatures(good, params).error().where == "threshold.points");
    CHECK(burstTimes({8000.0, 0, {}}, 67.0).error().where == "samples");
    CHECK(burstTimes({8000.0, 0, std::vector<double>(100, 0.0)}, 67.0).error().where == "samples");
    CHECK(burstTimes({8000.0, 0, {1.0}}, 5000.0).error().where == "frequency");
    CHECK(burstTimes({8000.0, 0, {1.0}}, std::numeric_limits<double>::quiet_NaN()).error().where == "frequency");
    std::vector<double> cut;
    for (int n = 0; n < 400; ++n)
        cut.push_back(std::sin(0.05 * n));
    CHECK(burstTimes({8000.0, 0, cut}, 63.7).error().code == ErrorCode::truncated);
}

TEST_CASE("A resonance seen through a smoothing has the mean power of its neighbourhood", "[linearize]")
{
    for (const double q : {0.7, 4.0, 40.0})
        for (const int slope : {0, 1, 2})
            for (const double f : {20.0, 66.0, 70.0, 300.0})
            {
                CAPTURE(q, slope, f);
                ResonanceModel model;
                model.q = q;
                model.slope = slope;
                model.gain = -7.0;
                CHECK(model.level(f) == Approx(secondOrder(f, 67.0, q, slope) - 7.0));
                const double octaves = 1.0 / 12.0;
                double power = 0.0;
                constexpr int pieces = 2000;
                for (int i = 0; i < pieces; ++i)
                {
                    const double at = f * std::exp2(octaves * ((i + 0.5) / pieces - 0.5));
                    power += std::pow(10.0, secondOrder(at, 67.0, q, slope) / 10.0) / pieces;
                }
                CHECK(model.level(f, octaves) == Approx(10.0 * std::log10(power) - 7.0).margin(0.01));
            }
}

TEST_CASE("Features of responses of any kind are those that they were", "[linearize]")
{
    std::vector<double> values;
    for (const double f0 : {30.0, 67.0, 240.0, 400.0})
        for (const double q : {0.7, 4.0, 20.0})
        {
            const auto fine = resonant(f0, q, 2, 1.0 / 12.0, 0.3, 5);
            FrequencyResponse response; // of fewer points, to be quick
            for (std::size_t i = 0; i < fine.size(); i += 4)
            {
                response.frequency.push_back(fine.frequency[i]);
                response.level.push_back(fine.level[i]);
            }
            ResponseFeatureParams params;
            params.evenWithin = 2.0;
            params.feltBelow = 12.0;
            params.highFrequency = 900.0;
            for (const bool threshold : {false, true})
            {
                if (threshold)
                    params.threshold = FrequencyResponse{logSpaced(15.0, 1200.0, 9), {9, 8, 7, 6, 5, 6, 8, 11, 14}};
                const auto features = responseFeatures(response, params).value();
                values.insert(values.end(),
                              {std::log(features.resonance.frequency), std::log(features.resonance.q), features.plateau,
                               std::log(1.0 + features.even.low), std::log(1.0 + features.even.high),
                               std::log(1.0 + features.felt.low), std::log(1.0 + features.felt.high)});
            }
        }
    checkPinned("linearize/features", values, 1e-4);
    const ResponseFeatureParams defaults;
    CHECK(defaults.lowFrequency == 20.0);
    CHECK(defaults.highFrequency == 1000.0);
    CHECK(defaults.smoothing == 1.0 / 12.0);
    CHECK(defaults.evenWithin == 3.0);
    CHECK(defaults.feltBelow == 20.0);
    CHECK(FrequencyRange{} == FrequencyRange{0.0, 0.0});
    CHECK(ResponseFeatures{}.plateau == 0.0);

    std::vector<double> times;
    for (const double q : {1.0, 3.0, 8.0})
        for (const double f : {40.0, 67.0, 120.0})
        {
            ImpulseResponse response{4000.0, 30, std::vector<double>(30, 0.0)};
            for (int n = 0; n < 3000; ++n)
                response.samples.push_back(std::exp(-0.5 * 0.105 * n / q) * std::sin(0.105 * n + 0.3));
            const auto burst = burstTimes(response, f).value();
            times.insert(times.end(), {burst.riseTime, burst.fallTime});
        }
    checkPinned("linearize/burst times", times, 1e-6);
    // one sample at the arrival: there at once, and gone with it
    const auto instant = burstTimes({1000.0, 2, {0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 0.0, 0.0}}, 100.0).value();
    CHECK(instant.riseTime == 0.0);
    CHECK(instant.fallTime == 0.0);
    CHECK(burstTimes({1000.0, 0, {1.0}}, 500.0).error().message ==
          "must be above 0 Hz and below half of the sample rate");
    CHECK(burstTimes({1000.0, 0, {1.0}}, 0.0).error().code == ErrorCode::invalidArgument);
}
