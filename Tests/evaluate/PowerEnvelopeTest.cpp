#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/evaluate/PowerEnvelope.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
/// Noise and a tone with knocks every 0.4 s.
std::vector<float> poweredSound(std::size_t frames)
{
    std::vector<float> x(frames);
    Random random(91);
    for (std::size_t n = 0; n < frames; ++n)
    {
        const double t = static_cast<double>(n) / 4000.0;
        const double knock = std::exp(-std::fmod(t + 0.13, 0.4) / 0.03);
        x[n] = static_cast<float>((0.05 + knock) *
                                  (0.5 * std::sin(2.0 * std::numbers::pi * 83.0 * t) + random.uniform(-0.4, 0.4)));
    }
    return x;
}

void pinEnvelope(const std::string& name, const PowerEnvelope& found)
{
    const std::vector<double> all(found.envelope.begin(), found.envelope.end());
    checkPinnedWithEnds("evaluate/" + name, all);
    checkPinned("evaluate/" + name + ", events", found.events);
}
} // namespace

TEST_CASE("Power envelopes and their events are what they were, for short sounds", "[evaluate]")
{
    PowerEnvelopeAnalyzer analyzer;
    for (const std::size_t length : {1u, 2u, 3u, 20u, 21u, 500u, 4096u, 9001u})
    {
        const auto found = analyzer.analyze(poweredSound(length));
        CHECK(found.envelope.size() == (length + 19) / 20);
        pinEnvelope("power envelope of " + std::to_string(length), found);
    }
    CHECK(analyzer.analyze({}).envelope.empty());
    CHECK(analyzer.analyze({}).events.empty());
}

TEST_CASE("Power envelopes around the longest transform and where pieces meet are what they were", "[evaluate]")
{
    PowerEnvelopeAnalyzer analyzer;
    for (const std::size_t length : {65535u, 65536u, 130000u})
    {
        auto x = poweredSound(length);
        const auto found = analyzer.analyze(x);
        CHECK(found.envelope.size() == (length + 19) / 20);
        pinEnvelope("power envelope of " + std::to_string(length), found);
        const auto cut = static_cast<std::ptrdiff_t>(61520 / 20);
        if (length > 65536)
            checkPinned("evaluate/power envelope where two pieces meet",
                        std::vector<double>(found.envelope.begin() + cut - 10, found.envelope.begin() + cut + 10),
                        1e-4);
    }
}

TEST_CASE("The end of a sound reaches its beginning across the zeros up to the next power of two", "[evaluate]")
{
    // By definition: the analytic signal of a circular transform of 8 samples, whose squares are smoothed.
    const std::vector<float> x{0.3f, -0.2f, 0.5f, 0.1f, -0.4f, 0.25f, 0.6f};
    const auto found = PowerEnvelopeAnalyzer().analyze(x);
    REQUIRE(found.envelope.size() == 1);
    const double pi = std::numbers::pi;
    double sum = 0.0;
    double weights = 0.0;
    for (int n = 0; n < 8; ++n)
    {
        double re = 0.0;
        double im = 0.0;
        for (int k = 0; k <= 4; ++k)
            for (int i = 0; i < 7; ++i)
            {
                const double w =
                    (k == 0 || k == 4 ? 1.0 : 2.0) / 8.0 * static_cast<double>(x[static_cast<std::size_t>(i)]);
                re += w * std::cos(2.0 * pi * k * (n - i) / 8.0);
                im += w * std::sin(2.0 * pi * k * (n - i) / 8.0);
            }
        if (n < 7)
            sum += 0.5 * (re * re + im * im) * (0.5 + 0.5 * std::cos(pi * n / 41.0));
    }
    for (int n = -40; n <= 40; ++n)
        weights += 0.5 + 0.5 * std::cos(pi * n / 41.0);
    CHECK(found.envelope.front() == Approx(std::sqrt(sum / weights)).epsilon(1e-5));
}

TEST_CASE("Kernels of the similarity have an odd number of taps", "[evaluate]")
{
    CHECK(htsHannKernel(Seconds(0.020)).reachFrames() == 40);
    CHECK(htsHannKernel(Seconds(0.010)).reachFrames() == 20);
    CHECK(htsHannKernel(Seconds(0.0)).reachFrames() == 0);
    CHECK(htsHannKernel(Seconds(0.00075)).reachFrames() == 1);
    CHECK(htsHannKernel(Seconds(0.0005)).reachFrames() == 1);
    CHECK(htsHannKernel(Seconds(0.001)).reachFrames() == 2);
}
