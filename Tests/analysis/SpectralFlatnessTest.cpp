#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/analysis/methods/CentroidFlatness.h>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("Flatness is the geometric over the arithmetic mean", "[analysis]")
{
    CHECK(flatnessOf(std::vector<double>{3.0, 3.0, 3.0}) == Approx(1.0));
    CHECK(flatnessOf(std::vector<double>{1.0, 4.0}) == Approx(2.0 / 2.5));
    CHECK(flatnessOf(std::vector<double>{1.0, 10.0, 100.0}) == Approx(10.0 / 37.0));
    CHECK(flatnessOf(std::vector<double>{1.0, 0.0}) == 0.0);
    CHECK(flatnessOf(std::vector<double>{0.0, 0.0}) == 0.0);
    CHECK(flatnessOf({}) == 0.0);
    const std::vector<double> huge(5000, 1e200);
    CHECK(flatnessOf(huge) == Approx(1.0)); // the product of the bins itself would overflow
}

TEST_CASE("White noise is 0.561 flat, a click 1, a sinusoid 0", "[analysis]")
{
    for (const double fs : {8000.0, 48000.0, 384000.0})
    {
        CAPTURE(fs);
        const auto frames = static_cast<std::size_t>(2.0 * fs);
        double mean = 0.0;
        const auto curve = spectralFlatness(noise(frames, 17), fs);
        for (const auto& point : curve)
            mean += point.value / static_cast<double>(curve.size());
        CHECK(mean == Approx(std::exp(-0.57721566490153286)).margin(0.02));

        const auto tone = spectralFlatness(sine(frames, 440.0, fs), fs);
        CHECK(tone[10].value < 1e-4);

        const auto window = FrameGrid(FrameParams{}, fs).window;
        const auto click = spectralFlatness(impulse(window, window / 2), fs);
        CHECK(click[0].value == Approx(1.0).epsilon(1e-9));
    }
}

TEST_CASE("Flatness within a range ignores what lies outside it", "[analysis]")
{
    const double fs = 8000.0;
    auto x = sine(8000, 3000.0, fs, 100.0);
    const auto hiss = noise(8000, 4);
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += hiss[i];
    SpectralFlatnessParams params;
    CHECK(spectralFlatness(x, fs, params)[20].value < 0.1);
    params.high = 2500_Hz;
    CHECK(spectralFlatness(x, fs, params)[20].value > 0.4);
    params.low = 2600_Hz;
    CHECK(spectralFlatness(x, fs, params)[20].value == 0.0); // no bins
}

TEST_CASE("Flatness of silence and of nothing is defined", "[analysis]")
{
    CHECK(spectralFlatness({}, 8000.0).empty());
    for (const auto& point : spectralFlatness(std::vector<float>(3000, 0.0f), 8000.0))
        CHECK(point.value == 0.0);
    CHECK(spectralFlatness(std::vector<float>(1, 1.0f), 8000.0).size() == 1);
}
