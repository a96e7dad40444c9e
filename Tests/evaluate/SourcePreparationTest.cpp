#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Measure.h"

#include <pacini/evaluate/SourcePreparation.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace pacini;

namespace
{
std::vector<double> sine(double f, int rate)
{
    std::vector<double> x(static_cast<std::size_t>(rate));
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = 0.25 * std::sin(2.0 * std::numbers::pi * f * static_cast<double>(i) / rate);
    return x;
}

} // namespace

TEST_CASE("A prepared source equals the golden band-limited and normalised signal", "[evaluate]")
{
    const auto file = test::golden("preprocess");
    auto x = file["left"].get<std::vector<double>>();
    for (double& v : x)
        v *= 0.5; // the mean of it and a silent channel
    const int rate = file["fs"];
    const auto y = prepareSource(std::span<const double>(x), rate, rate).value();
    const auto expected = file["out"].get<std::vector<double>>();
    REQUIRE(y.size() == expected.size());
    for (std::size_t i = 0; i < y.size(); ++i)
        CHECK(std::abs(y[i] - expected[i]) < file["tol"].get<double>());
}

TEST_CASE("A prepared source peaks at one before resampling and keeps its length", "[evaluate]")
{
    for (const int rate : {8000, 44100, 48000, 96000})
    {
        CAPTURE(rate);
        // 80 output samples per period: some lie within 0.1 % of the peak, which is in the first period, where the
        // high-pass starts.
        const auto y = prepareSource(std::span<const double>(sine(50.0, rate)), rate, 4000).value();
        CHECK(y.size() == 4000);
        CHECK(test::peakOf(y) == Approx(1.0).margin(0.005));
    }
}

TEST_CASE("Blocks do not show in a prepared source", "[evaluate]")
{
    // A sine through linear filters stays a sine: any seam would show against the ideal continuation.
    const auto y = prepareSource(std::span<const double>(sine(100.0, 96000)), 96000, 4000).value();
    for (std::size_t i = 2000; i + 100 < y.size(); ++i)
    {
        const double c = 2.0 * std::cos(2.0 * std::numbers::pi * 100.0 / 4000.0);
        CHECK(std::abs(y[i + 1] - (c * y[i] - y[i - 1])) < 2e-3);
    }
}

TEST_CASE("Silent and empty sources stay so, and samples that are not finite count as silence", "[evaluate]")
{
    CHECK(prepareSource(std::span<const float>(), 44100, 4000).value().empty());
    const std::vector<float> silence(4410);
    CHECK(prepareSource(std::span<const float>(silence), 44100, 4000).value() == std::vector<float>(400));
    std::vector<float> bad(4410, std::numeric_limits<float>::quiet_NaN());
    CHECK(prepareSource(std::span<const float>(bad), 44100, 4000).value() == std::vector<float>(400));
    CHECK_FALSE(prepareSource(std::span<const float>(silence), 1000, 4000).ok());
}
