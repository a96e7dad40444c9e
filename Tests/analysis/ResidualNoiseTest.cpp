#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/analysis/ResidualNoise.h>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("White residual noise has in every band its share of the power", "[analysis]")
{
    for (const double fs : {8000.0, 48000.0})
    {
        const auto frames = static_cast<std::size_t>(20.0 * fs);
        const auto tone = sine(frames, 200.0, fs, 0.5);
        auto x = noise(frames, 21); // variance 1/3
        for (std::size_t i = 0; i < frames; ++i)
            x[i] += tone[i];
        const auto bands = residualNoise(x, tone, fs);
        REQUIRE(bands.size() == 6);
        for (const auto& band : bands)
        {
            double power = 0.0;
            for (const auto& point : band.amplitude)
                power += point.value * point.value / static_cast<double>(band.amplitude.size());
            const double share = (band.highFrequency - band.lowFrequency) / (0.5 * fs);
            CAPTURE(fs, band.lowFrequency);
            CHECK(power == Approx(share / 3.0).epsilon(0.15));
        }
    }
}

TEST_CASE("A sinusoid that the model misses appears as its RMS in its own band", "[analysis]")
{
    const double fs = 8000.0;
    ResidualNoiseParams params;
    params.layout = {3, 100_Hz, 3200_Hz, BandSpacing::logarithmic, BandLayoutKind::tiled};
    const auto bands = residualNoise(sine(16000, 1800.0, fs, 0.6), std::vector<float>(16000, 0.0f), fs, params);
    REQUIRE(bands.size() == 3);
    CHECK(bands[2].lowFrequency == Approx(1007.9).epsilon(1e-3));
    CHECK(valueAt(bands[2].amplitude, 1.0) == Approx(0.6 / std::sqrt(2.0)).epsilon(1e-3));
    CHECK(valueAt(bands[0].amplitude, 1.0) < 1e-3);
}

TEST_CASE("Bands over the whole spectrum add up to the power of the residual", "[analysis]")
{
    const double fs = 4000.0;
    ResidualNoiseParams params;
    params.layout = {8, 1_Hz, 2000_Hz, BandSpacing::logarithmic, BandLayoutKind::tiled};
    params.frames = {0.256_s, 0.064_s};
    const auto x = noise(1024, 3);
    const auto bands = residualNoise(x, std::vector<float>(1024, 0.0f), fs, params);
    double power = 0.0;
    for (const auto& band : bands)
        power += band.amplitude[0].value * band.amplitude[0].value;
    double weighted = 0.0; // mean square under the squared Hann window, whose mean is 3/8
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        const double hann = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / 1024.0);
        weighted += hann * hann * static_cast<double>(x[i]) * static_cast<double>(x[i]) / (1024.0 * 0.375);
    }
    CHECK(power == Approx(weighted).epsilon(0.01));
}

TEST_CASE("A perfect model leaves no residual noise, and nothing has none", "[analysis]")
{
    const auto x = noise(3000, 8);
    for (const auto& band : residualNoise(x, x, 8000.0))
        for (const auto& point : band.amplitude)
            CHECK(point.value == 0.0);
    for (const double fs : {8000.0, 384000.0})
    {
        for (const auto& band : residualNoise({}, {}, fs))
            CHECK(band.amplitude.empty());
        for (const auto& band : residualNoise(std::vector<float>(1, 1.0f), std::vector<float>(1, 0.5f), fs))
        {
            REQUIRE(band.amplitude.size() == 1);
            CHECK(std::isfinite(band.amplitude[0].value));
        }
    }
}
