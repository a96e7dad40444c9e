#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/evaluate/FeltSpectrum.h>
#include <pacini/foundation/Random.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
std::vector<float> feltSound(std::size_t frames)
{
    std::vector<float> x(frames);
    Random random(5);
    for (std::size_t n = 0; n < frames; ++n)
    {
        const double t = 2.0 * std::numbers::pi * static_cast<double>(n) / 4000.0;
        x[n] = static_cast<float>(0.4 * std::sin(37.0 * t) + 0.3 * std::sin(222.0 * t) + random.uniform(-0.5, 0.5));
    }
    return x;
}
} // namespace

TEST_CASE("Felt spectra cover a sound of any length and are what they were", "[evaluate]")
{
    FeltSpectrumAnalyzer analyzer;
    for (const auto& [length, frames] : {std::pair<std::size_t, std::size_t>{0, 1},
                                         {1, 1},
                                         {511, 1},
                                         {512, 1},
                                         {513, 2},
                                         {768, 2},
                                         {769, 3},
                                         {1024, 3},
                                         {2000, 7}})
    {
        const auto found = analyzer.analyze(feltSound(length));
        CAPTURE(length);
        REQUIRE(found.size() == frames);
        for (std::size_t m = 0; m < found.size() && length > 1; ++m)
            checkPinned("evaluate/felt spectrum of " + std::to_string(length) + ", frame " + std::to_string(m),
                        std::vector<double>(found[m].begin(), found[m].end()), 1e-4);
    }
    const auto silent = analyzer.analyze(std::vector<float>(900));
    for (const float v : silent[1])
        CHECK(v == 0.0f);
}

TEST_CASE("A tone in the middle of a felt band has its RMS there, and weighs 1 2 3 2 1 around", "[evaluate]")
{
    FeltSpectrumAnalyzer analyzer;
    for (const std::size_t band : {14u, 17u, 18u})
    {
        const double f = 25.0 * std::pow(1.2, static_cast<double>(band) + 0.5);
        std::vector<float> x(512);
        for (std::size_t n = 0; n < x.size(); ++n)
            x[n] = static_cast<float>(0.6 * std::sin(2.0 * std::numbers::pi * f * static_cast<double>(n) / 4000.0));
        const auto frame = analyzer.analyze(x).front();
        const double ninths[] = {1.0, 2.0, 3.0, 2.0, 1.0};
        for (std::size_t i = 0; i < 5 && band + i - 2 < frame.size(); ++i)
            CHECK(frame[band + i - 2] == Approx(0.6 * std::sqrt(0.5 * ninths[i] / 9.0)).epsilon(0.01));
        CHECK(frame[band - 4] < 0.01f);
    }
}
