#include "cli/bench/YuleWalker.h"

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
FrequencyResponse spring(double resonance, double q)
{
    FrequencyResponse response;
    response.frequency = logFrequencies(256, 30.0, 1000.0);
    for (const double f : response.frequency)
        response.level.push_back(massOnSpring(f, resonance, q));
    return response;
}

double levelOf(const YuleWalkerFit& fit, double f, double fs)
{
    return 20.0 * std::log10(std::abs(spectrumAt(std::span<const double>(fit.numerator), f, fs) /
                                      spectrumAt(std::span<const double>(fit.denominator), f, fs)));
}

/// How often 1 + a[1] z^-1 + ... turns around 0 while z goes around the unit circle: as many roots lie outside.
int rootsOutside(const std::vector<double>& polynomial)
{
    constexpr int steps = 1 << 16;
    double turned = 0.0;
    std::complex<double> before = spectrumAt(std::span<const double>(polynomial), 0.0, 1.0);
    for (int k = 1; k <= steps; ++k)
    {
        const auto now = spectrumAt(std::span<const double>(polynomial), static_cast<double>(k) / steps, 1.0);
        turned += std::arg(now / before);
        before = now;
    }
    return static_cast<int>(std::lround(std::abs(turned) / (2.0 * std::numbers::pi)));
}
} // namespace

TEST_CASE("A Yule-Walker equaliser comes nearer to flat with its order at a decimated rate", "[linearize]")
{
    const FrequencyResponse response = spring(67.0, 4.0);
    double before = 100.0;
    for (const int order : {4, 16, 64, 128})
    {
        CAPTURE(order);
        const auto fit = fitYuleWalker(response, order, fitParamsAt(4000.0));
        REQUIRE(fit.ok());
        FrequencyResponse sum = response;
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum.level[i] += levelOf(*fit, sum.frequency[i], 4000.0);
        const Deviation deviation = deviationOf(sum, EqualizerSections{}, 4000.0);
        CHECK(fit->rms == Approx(deviation.rms).margin(1e-5));
        CHECK(fit->max == Approx(deviation.max).margin(1e-5));
        CHECK(fit->level == Approx(deviation.level).margin(1e-5));
        CHECK(deviation.rms < before);
        before = deviation.rms;
    }
    CHECK(before <= 0.1);
}

TEST_CASE("A Yule-Walker equaliser is stable and of minimum phase, at high rates and orders too", "[linearize]")
{
    for (const double fs : {4000.0, 48000.0})
        for (const int order : {2, 8, 32, 128})
        {
            CAPTURE(fs, order);
            const auto fit = fitYuleWalker(spring(175.0, 20.0), order, fitParamsAt(fs));
            REQUIRE(fit.ok());
            CHECK(fit->denominator.size() == static_cast<std::size_t>(order) + 1);
            CHECK(fit->numerator.size() == static_cast<std::size_t>(order) + 1);
            CHECK(fit->denominator[0] == 1.0);
            CHECK(rootsOutside(fit->denominator) == 0);
            CHECK(rootsOutside(fit->numerator) == 0);
        }
}

TEST_CASE("At 48 kHz the order of a Yule-Walker equaliser does not reach a resonance of an actuator", "[linearize]")
{
    const auto low = fitYuleWalker(spring(67.0, 4.0), 32, fitParamsAt(48000.0));
    const auto decimated = fitYuleWalker(spring(67.0, 4.0), 32, fitParamsAt(4000.0));
    REQUIRE(low.ok());
    REQUIRE(decimated.ok());
    CHECK(low->rms > 5.0 * decimated->rms);
}

TEST_CASE("Levinson's predictor of an autoregressive process is its own polynomial", "[linearize]")
{
    // poles at 0.9 exp(+-j 0.7) and 0.5
    const std::vector<double> wanted = {1.0, -2.0 * 0.9 * std::cos(0.7) - 0.5, 0.81 + 0.9 * std::cos(0.7), -0.405};
    std::vector<double> h(600);
    for (std::size_t n = 0; n < h.size(); ++n)
    {
        h[n] = n == 0 ? 1.0 : 0.0;
        for (std::size_t k = 1; k < wanted.size() && k <= n; ++k)
            h[n] -= wanted[k] * h[n - k];
    }
    std::vector<double> r(10, 0.0);
    for (std::size_t lag = 0; lag < r.size(); ++lag)
        for (std::size_t n = lag; n < h.size(); ++n)
            r[lag] += h[n] * h[n - lag];
    const auto found = cli::detail::levinson(r, 6);
    REQUIRE(found.size() == 7);
    for (std::size_t k = 0; k < found.size(); ++k)
        CHECK(found[k] == Approx(k < wanted.size() ? wanted[k] : 0.0).margin(1e-9));
}

TEST_CASE("A Yule-Walker equaliser keeps the limit of the boost", "[linearize]")
{
    for (const double most : {0.0, 6.0, 12.0})
        for (const int order : {4, 16, 64})
        {
            CAPTURE(most, order);
            EqualizerFitParams params = fitParamsAt(8000.0);
            params.maxBoost = most;
            const auto fit = fitYuleWalker(spring(90.0, 8.0), order, params);
            REQUIRE(fit.ok());
            for (const double f : logFrequencies(500, 5.0, 3999.0))
                CHECK(levelOf(*fit, f, 8000.0) <= most + 0.1);
        }
}

TEST_CASE("What a Yule-Walker equaliser cannot be made of is refused by name", "[linearize]")
{
    for (const int wrong : {-1, 0, 1, 129})
        CHECK(fitYuleWalker(spring(67.0, 4.0), wrong).error().where == "order");
    FrequencyResponse bad = spring(67.0, 4.0);
    bad.frequency[3] = std::numeric_limits<double>::infinity();
    CHECK(fitYuleWalker(bad, 8).error().where == "points[3].frequency");
}
