#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Measure.h"

#include <pacini/analysis/SpectralCentroid.h>

#include <limits>
#include <string>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("The spectral centroid equals the reference", "[analysis][golden]")
{
    const auto data = golden("centroid");
    const double fs = data["fs"];
    for (const auto& entry : data["cases"])
    {
        const std::string name = entry["signal"];
        CAPTURE(name, entry["win"].get<int>());
        SpectralCentroidParams params;
        params.frames = {Seconds(entry["win"].get<double>() / fs), Seconds(entry["hop"].get<double>() / fs)};
        const auto curve = spectralCentroid(data["inputs"][name].get<std::vector<float>>(), fs, params);
        REQUIRE(curve.size() == entry["hz"].size());
        for (std::size_t m = 0; m < curve.size(); ++m)
        {
            CHECK(curve[m].time == Approx(entry["t"][m].get<double>()).margin(1e-8));
            CHECK(std::abs(curve[m].value - entry["hz"][m].get<double>()) <= data["tol_hz"].get<double>());
        }
    }
}

TEST_CASE("The centroid of a sinusoid is its frequency at any sample rate", "[analysis]")
{
    for (const double fs : {8000.0, 44100.0, 48000.0, 384000.0})
        for (const double f : {100.0, 345.6, 1000.0})
        {
            const auto x = sine(static_cast<std::size_t>(0.3 * fs), f, fs);
            const auto curve = spectralCentroid(x, fs);
            CAPTURE(fs, f);
            REQUIRE(curve.size() > 10);
            // Away from the last frames, which the end of the tone cuts.
            for (std::size_t m = 0; m + 6 < curve.size(); ++m)
                CHECK(curve[m].value == Approx(f).epsilon(1e-3));
        }
}

TEST_CASE("The centroid weighs by power", "[analysis]")
{
    const double fs = 8000.0;
    auto x = sine(8000, 250.0, fs, 0.8);
    const auto y = sine(8000, 750.0, fs, 0.4);
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += y[i];
    SpectralCentroidParams params;
    params.frames = {0.128_s, 0.032_s};
    CHECK(spectralCentroid(x, fs, params)[5].value == Approx((0.64 * 250.0 + 0.16 * 750.0) / 0.8).epsilon(1e-4));
    params.low = 500_Hz;
    CHECK(spectralCentroid(x, fs, params)[5].value == Approx(750.0).epsilon(1e-4));
    params.low = 0_Hz;
    params.high = 500_Hz;
    CHECK(spectralCentroid(x, fs, params)[5].value == Approx(250.0).epsilon(1e-4));
}

TEST_CASE("The centroid of silence, of nothing and of one sample is defined", "[analysis]")
{
    for (const double fs : {8000.0, 384000.0})
    {
        CHECK(spectralCentroid({}, fs).empty());
        const auto one = spectralCentroid(std::vector<float>(1, 1.0f), fs);
        REQUIRE(one.size() == 1);
        CHECK(std::isfinite(one[0].value));
        for (const auto& point : spectralCentroid(std::vector<float>(9000, 0.0f), fs))
            CHECK(point.value == 0.0);
        auto bad = noise(9000, 1);
        bad[10] = std::numeric_limits<float>::quiet_NaN();
        bad[11] = std::numeric_limits<float>::infinity();
        for (const auto& point : spectralCentroid(bad, fs))
            CHECK(std::isfinite(point.value));
    }
}

TEST_CASE("Windows and hops of any length are made usable", "[analysis]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto x = noise(500, 3);
    for (const double window : {nan, -1.0, 0.0, 1e-9, 0.01, 1e9})
        for (const double hop : {nan, -1.0, 0.0, 0.01, 1e9})
        {
            SpectralCentroidParams params;
            params.frames = {Seconds(window), Seconds(hop)};
            const auto curve = spectralCentroid(x, 1000.0, params);
            REQUIRE(!curve.empty());
            for (std::size_t m = 1; m < curve.size(); ++m)
                REQUIRE(curve[m].time > curve[m - 1].time);
        }
}
