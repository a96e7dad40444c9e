#include "cli/bench/FirFit.h"

#include "linearize/EqualizerReference.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <limits>
#include <span>

using namespace pacini;
using namespace pacini::cli;
using namespace pacini::test;

namespace
{
FrequencyResponse coil(double noise = 0.0)
{
    FrequencyResponse response;
    Random random(3);
    response.frequency = logFrequencies(256, 30.0, 1000.0);
    for (const double f : response.frequency)
        response.level.push_back(massOnSpring(f, 67.0, 4.0) + noise * random.uniform(-1.0, 1.0));
    return response;
}

double levelOf(const FirFit& fit, double f, double fs)
{
    return 20.0 * std::log10(std::abs(spectrumAt(std::span<const double>(fit.taps), f, fs)));
}

Deviation deviationWith(const FrequencyResponse& response, const FirFit& fit, double fs)
{
    FrequencyResponse sum = response;
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum.level[i] += levelOf(fit, sum.frequency[i], fs);
    return deviationOf(sum, EqualizerSections{}, fs);
}

FirFit fitOf(const FrequencyResponse& response, int taps, const EqualizerFitParams& params,
             FirPhase phase = FirPhase::linear)
{
    const auto fit = fitFir(response, taps, params, phase);
    REQUIRE(fit.ok());
    return *fit;
}
} // namespace

TEST_CASE("A FIR equaliser comes nearer to flat the longer it is", "[linearize]")
{
    const FrequencyResponse response = coil();
    double before = 100.0;
    for (const int taps : {64, 128, 256, 512, 1024})
    {
        CAPTURE(taps);
        const FirFit fit = fitOf(response, taps, fitParamsAt(4000.0));
        const Deviation deviation = deviationWith(response, fit, 4000.0);
        CHECK(deviation.rms < before);
        CHECK(fit.rms == Approx(deviation.rms).margin(1e-6));
        CHECK(fit.max == Approx(deviation.max).margin(1e-6));
        CHECK(fit.level == Approx(deviation.level).margin(1e-6));
        before = deviation.rms;
    }
    CHECK(before <= 0.03);
}

TEST_CASE("A linear-phase equaliser is symmetric and delays by half its length", "[linearize]")
{
    const FirFit fit = fitOf(coil(), 512, fitParamsAt(8000.0));
    REQUIRE(fit.taps.size() == 511); // odd
    for (std::size_t n = 0; n < fit.taps.size(); ++n)
        CHECK(fit.taps[n] == fit.taps[fit.taps.size() - 1 - n]);
    CHECK(fit.latency == 255.0 / 8000.0);
}

TEST_CASE("A minimum-phase equaliser has its energy at its start and the same magnitude", "[linearize]")
{
    const FrequencyResponse response = coil();
    const FirFit fit = fitOf(response, 2048, fitParamsAt(4000.0), FirPhase::minimum);
    CHECK(fit.latency == 0.0);
    CHECK(deviationWith(response, fit, 4000.0).rms <= 0.1);
    double whole = 0.0, start = 0.0;
    for (std::size_t n = 0; n < fit.taps.size(); ++n)
    {
        whole += fit.taps[n] * fit.taps[n];
        if (n < 16)
            start += fit.taps[n] * fit.taps[n];
    }
    CHECK(start > 0.7 * whole);
}

TEST_CASE("The least-squares taps cannot be improved by changing one of them", "[linearize]")
{
    // The weighted sum of squares that is said to be least, by its definition.
    const double fs = 4000.0;
    const auto problem = makeEqualizerFitProblem(coil(), fitParamsAt(fs));
    REQUIRE(problem.ok());
    const std::size_t size = 4096;
    const std::vector<double> amplitude = amplitudesOf(EqualizerTarget(*problem), size, fs);
    const std::vector<double> taps = cli::detail::symmetricTaps(*problem, amplitude, 20);
    const auto costOf = [&](const std::vector<double>& half)
    {
        double sum = 0.0;
        for (std::size_t k = 0; k <= size / 2; ++k)
        {
            const double f = fs * static_cast<double>(k) / static_cast<double>(size);
            double value = half[0];
            for (std::size_t m = 1; m < half.size(); ++m)
                value += 2.0 * half[m] * std::cos(2.0 * std::numbers::pi * f / fs * static_cast<double>(m));
            const double share = (f < 30.0 || f > 1000.0 ? 0.01 : 1.0) / std::max(f, 30.0);
            const double error = (value - amplitude[k]) / amplitude[k];
            sum += (k == 0 || k == size / 2 ? 0.5 : 1.0) * share * error * error;
        }
        return sum;
    };
    const std::vector<double> half(taps.begin() + 20, taps.end());
    const double least = costOf(half);
    for (std::size_t m = 0; m < half.size(); ++m)
        for (const double step : {-1e-3, 1e-3})
        {
            auto moved = half;
            moved[m] += step * half[0];
            CHECK(costOf(moved) > least);
        }
}

TEST_CASE("A FIR equaliser keeps the limit of the boost at every frequency", "[linearize]")
{
    for (const double most : {0.0, 6.0, 12.0})
        for (const int taps : {32, 256, 1024})
            for (const FirPhase phase : {FirPhase::linear, FirPhase::minimum})
            {
                CAPTURE(most, taps);
                EqualizerFitParams params = fitParamsAt(8000.0);
                params.maxBoost = most;
                const FirFit fit = fitOf(coil(1.0), taps, params, phase);
                for (const double f : logFrequencies(500, 5.0, 3999.0))
                    CHECK(levelOf(fit, f, 8000.0) <= most + 0.1);
            }
}

TEST_CASE("What a FIR equaliser cannot be made of is refused by name", "[linearize]")
{
    const FrequencyResponse good = coil();
    for (const int wrong : {-1, 0, 14, 4098})
    {
        const auto fit = fitFir(good, wrong);
        REQUIRE_FALSE(fit.ok());
        CHECK(fit.error().where == "taps");
    }
    FrequencyResponse bad = good;
    bad.level[3] = std::numeric_limits<double>::quiet_NaN();
    CHECK(fitFir(bad, 64).error().where == "points[3].level");
}
