#include "support/Catch.h"

#include <pacini/evaluate/Hts.h>
#include <pacini/evaluate/LowPart.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
constexpr int lowRate = 8000;

/// Kicks of 60 Hz every half second; a tone of `frequency` with `amplitude` between and under them.
std::vector<float> kicks(double kick, double amplitude, double frequency)
{
    std::vector<float> x(4 * lowRate);
    for (std::size_t n = 0; n < x.size(); ++n)
    {
        const double t = static_cast<double>(n) / lowRate;
        const double since = std::fmod(t, 0.5);
        x[n] = static_cast<float>(kick * std::exp(-since / 0.06) * std::sin(2.0 * std::numbers::pi * 60.0 * since) +
                                  amplitude * std::sin(2.0 * std::numbers::pi * frequency * t));
    }
    return x;
}

LowPart compared(const std::vector<float>& sound, const std::vector<float>& drive)
{
    HtsAnalyzer analyzer;
    return compareLowPart(htsSourceFeatures(analyzer, std::span<const float>(sound), lowRate).value(),
                          htsCandidateFeatures(analyzer, std::span<const float>(drive), lowRate).value());
}
} // namespace

TEST_CASE("A sound keeps all of its low part and beat, whatever its level", "[evaluate]")
{
    const auto sound = kicks(0.8, 0.02, 200.0);
    auto louder = sound;
    for (float& v : louder)
        v *= 0.3f;
    for (const auto& drive : {sound, louder})
    {
        const LowPart low = compared(sound, drive);
        REQUIRE(low.kept);
        REQUIRE(low.beat);
        CHECK(*low.kept > 0.97); // the sound alone is limited to 5 Hz to 1.8 kHz
        CHECK(*low.beat == Approx(1.0).margin(0.05));
    }
}

TEST_CASE("A tone that fills the pauses costs the beat, a level without kicks both", "[evaluate]")
{
    const auto sound = kicks(0.8, 0.02, 200.0);
    const LowPart filled = compared(sound, kicks(0.8, 0.5, 200.0));
    CHECK(*filled.beat < 0.3);
    CHECK(*filled.kept > 0.4);
    const LowPart gone = compared(sound, kicks(0.0, 0.5, 200.0));
    CHECK(*gone.beat < 0.15);
    CHECK(*gone.kept < 0.3);
    // 20 ms late or early counts alike; 100 ms do not.
    auto late = sound;
    late.insert(late.begin(), lowRate / 50, 0.0f);
    CHECK(*compared(sound, late).kept > 0.95);
    late.insert(late.begin(), lowRate / 10, 0.0f);
    CHECK(*compared(sound, late).kept < 0.7);
}

TEST_CASE("Sounds without a low part or a beat have no such measure", "[evaluate]")
{
    const auto high = kicks(0.0, 0.5, 1000.0);
    CHECK_FALSE(compared(high, high).kept);
    CHECK_FALSE(compared(high, high).beat);
    const auto steady = kicks(0.0, 0.5, 60.0);
    CHECK(compared(steady, steady).kept);
    CHECK_FALSE(compared(steady, steady).beat);
    const std::vector<float> silence(lowRate);
    CHECK_FALSE(compared(silence, high).kept);
}
