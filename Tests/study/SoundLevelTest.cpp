#include "study/SoundLevel.h"

#include "study/StudyCheck.h"
#include "study/StudyTemplates.h"
#include "support/Catch.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::study;

namespace
{
std::vector<float> sineOf(double frequency, double amplitude, double seconds, int fs = 48000)
{
    std::vector<float> samples(static_cast<std::size_t>(seconds * fs));
    for (std::size_t n = 0; n < samples.size(); ++n)
        samples[n] =
            static_cast<float>(amplitude * std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(n) / fs));
    return samples;
}
} // namespace

TEST_CASE("A-weighting is that of IEC 61672-1, table 3, within a tenth of a decibel")
{
    for (const auto& [frequency, decibels] : std::vector<std::pair<double, double>>{{31.623, -39.4},
                                                                                    {63.096, -26.2},
                                                                                    {125.893, -16.1},
                                                                                    {251.189, -8.6},
                                                                                    {501.187, -3.2},
                                                                                    {1000.0, 0.0},
                                                                                    {1995.26, 1.2},
                                                                                    {3981.07, 1.0},
                                                                                    {7943.28, -1.1},
                                                                                    {15848.9, -6.6}})
    {
        INFO(frequency);
        CHECK(10.0 * std::log10(weightingA(frequency)) == Approx(decibels).margin(0.06));
        // Without the clicks of its ends, whose spectrum is weighted higher than a low tone's.
        auto tone = sineOf(frequency, 1.0, 2.0);
        for (std::size_t n = 0; n < tone.size(); ++n)
        {
            const double half = std::sin(std::numbers::pi * static_cast<double>(n) / static_cast<double>(tone.size()));
            tone[n] *= static_cast<float>(half * half);
        }
        const SoundLevels levels = levelsOf(tone, 48000);
        CHECK(levels.weighted - levels.rms == Approx(decibels).margin(0.07));
    }
}

TEST_CASE("Loudness is that of another program, both ears counted")
{
    if (!knowsLoudness())
        return;
    // pyloudnorm 0.1 of the same sines on two channels.
    CHECK(*levelsOf(sineOf(997.0, 0.1, 5.0), 48000).loudness == Approx(-20.0414).margin(0.05));
    CHECK(*levelsOf(sineOf(100.0, 0.3, 5.0), 48000).loudness == Approx(-12.3206).margin(0.05));
    CHECK(*levelsOf(sineOf(4000.0, 0.05, 5.0), 48000).loudness == Approx(-22.7865).margin(0.05));
    CHECK_FALSE(levelsOf(sineOf(997.0, 0.1, 0.2), 48000).loudness);
    CHECK_FALSE(levelsOf(std::vector<float>(48000, 0.0f), 48000).loudness);
}

TEST_CASE("A calibration gives levels at the ear: the tone itself has the level that was measured")
{
    const SoundCalibration calibration{-20.0, 74.0};
    const auto tone = calibrationTone(calibration, 30.0, 44100);
    const SoundLevels levels = levelsOf(tone, 44100);
    CHECK(heardLevel(calibration, levels.rms) == Approx(74.0).margin(0.03));
    CHECK(heardLevel(calibration, levels.weighted) == Approx(74.0).margin(0.03));
    CHECK(tone.front() == 0.0f);
    CHECK(std::isinf(levelsOf({}, 48000).rms));
}
