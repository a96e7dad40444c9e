#include "MethodSignals.h"
#include "support/BlockContract.h"
#include "support/Catch.h"

#include <pacini/analysis/methods/Modulation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("Every range of hearing is felt at a frequency of its own", "[methods]")
{
    const double fs = 44100.0;
    // In the middle of each range, and the carriers, from the words of the description.
    for (const auto& [tone, carrier] :
         {std::pair(173.0, 60.0), std::pair(517.0, 112.9), std::pair(1547.0, 212.5), std::pair(4627.0, 400.0)})
    {
        CAPTURE(tone);
        const Clip clip = modulationClip(sine(44100, tone, fs), fs);
        REQUIRE(clip.bands.size() == 4);
        const auto out = played(clip, 8000.0);
        CHECK(strongestFrequency(out, 20.0, 1000.0, 8000.0) == Approx(carrier).epsilon(2e-3));
    }
}

TEST_CASE("What is above the range of touch is felt by its level, not lost", "[methods]")
{
    const double fs = 44100.0;
    // Bursts at 6 kHz, four per second.
    auto bursts = sine(44100, 6000.0, fs);
    for (std::size_t n = 0; n < bursts.size(); ++n)
        bursts[n] *= n / 5512 % 2 == 0 ? 1.0f : 0.0f;
    const Clip clip = modulationClip(bursts, fs);
    const auto level = [&](double time)
    {
        return valueAt(clip.bands[3].amplitude, time);
    };
    for (int burst = 0; burst < 4; ++burst)
    {
        CAPTURE(burst);
        CHECK(level(0.25 * burst + 0.06) > 0.8);
        CHECK(level(0.25 * burst + 0.24) < 0.1);
    }
    CHECK(clip.bands[3].priority == 0);
}

TEST_CASE("All ranges at once stay within full drive", "[methods]")
{
    const Clip clip = modulationClip(noise(32000, 7), 16000.0);
    float largest = 0.0f;
    for (const float v : played(clip, 16000.0))
        largest = std::max(largest, std::abs(v));
    CHECK(largest < 1.05f);
    CHECK(largest > 0.3f);
}

TEST_CASE("Ranges end where the sample rate does", "[methods]")
{
    for (const double fs : {8000.0, 9600.0, 16000.0, 48000.0, 768000.0})
    {
        CAPTURE(fs);
        const Clip clip = modulationClip(noise(2000, 1), fs);
        REQUIRE(clip.bands.size() == 4);
        CHECK(clip.bands.front().lowFrequency == Approx(100.0));
        CHECK(clip.bands.back().highFrequency == Approx(std::min(8000.0, 0.45 * fs)));
        for (std::size_t k = 1; k < clip.bands.size(); ++k)
            CHECK(clip.bands[k].lowFrequency == Approx(clip.bands[k - 1].highFrequency));
    }
    ModulationParams lowest;
    lowest.lowest = Hertz(-5.0);
    lowest.highest = Hertz(0.0);
    lowest.channels = 0;
    CHECK(validate(modulationClip(noise(2000, 1), 8000.0, lowest)).ok());
    ModulationParams highest;
    highest.lowest = Hertz(1e6);
    highest.channels = 99;
    highest.highestCarrier = Hertz(1e9);
    CHECK(validate(modulationClip(noise(2000, 1), 8000.0, highest)).ok());
}
