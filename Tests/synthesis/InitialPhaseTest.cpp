// The initial phase of a band's carrier (Weber 2020, Eq. 4.13), from the clip to the samples.

#include "analysis/methods/MethodSignals.h"
#include "support/Catch.h"
#include "support/ClipSamples.h"

#include <pacini/actuator/BodyModel.h>
#include <pacini/clip/PackedClip.h>
#include <pacini/clip/edits/TimeEdits.h>
#include <pacini/foundation/Random.h>
#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/VoiceMerge.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
/// One second of a sine of 100 Hz at half of full drive, between silences of a tenth.
Clip tone(double phase)
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands.push_back({80.0, 100.0, 125.0, 0, {{0.0, 0.0}, {0.1, 0.5}, {0.9, 0.5}, {1.0, 0.0}}, {}, phase});
    return clip;
}

/// Phase of 100 Hz at the start, cycles from 0 to 1, from the middle of the sound.
double phaseOf(const std::vector<float>& x, double fs)
{
    double sine = 0.0;
    double cosine = 0.0;
    for (auto n = static_cast<std::size_t>(0.3 * fs); n < static_cast<std::size_t>(0.7 * fs); ++n)
    {
        const double angle = 2.0 * std::numbers::pi * 100.0 * static_cast<double>(n) / fs;
        sine += static_cast<double>(x[n]) * std::sin(angle);
        cosine += static_cast<double>(x[n]) * std::cos(angle);
    }
    const double cycles = std::atan2(cosine, sine) / (2.0 * std::numbers::pi);
    return cycles - std::floor(cycles);
}
} // namespace

TEST_CASE("A carrier starts at the phase of its band at every sample rate", "[clip][synthesis]")
{
    for (const double fs : {8000.0, 44100.0, 48000.0, 192000.0, 768000.0})
        for (const double phase : {0.0, 0.1, 0.25, 0.5, 0.9})
        {
            CAPTURE(fs, phase);
            CHECK(std::abs(std::remainder(phaseOf(test::played(tone(phase), fs), fs) - phase, 1.0)) < 2e-3);
        }
}

TEST_CASE("Whole cycles of phase change nothing, and any finite number is a phase to the decoder",
          "[synthesis][stability]")
{
    for (const double fs : {8000.0, 48000.0, 768000.0})
    {
        const auto without = test::played(tone(0.0), fs);
        CHECK(test::played(tone(1.0), fs) == without);
        CHECK(test::played(tone(0.25), fs) != without);
        for (const double phase : {-0.25, 7.75, -1e6 - 0.25, 1e15, -1e300, 5e-324, std::numeric_limits<double>::max()})
        {
            CAPTURE(fs, phase);
            CHECK(test::played(tone(phase), fs) == test::played(tone(phase - std::floor(phase)), fs));
        }
    }
}

TEST_CASE("Bands that become one voice keep the phase of the stronger", "[synthesis]")
{
    for (const bool lowerIsStronger : {true, false})
    {
        Clip clip = tone(0.3);
        clip.bands.push_back({125.0, 140.0, 160.0, 0, {{0.0, lowerIsStronger ? 0.1 : 0.9}}, {}, 0.7});
        mergeVoices(clip, 1);
        REQUIRE(clip.bands.size() == 1);
        CHECK(clip.bands[0].phase == (lowerIsStronger ? 0.3 : 0.7));
    }
}

TEST_CASE("A joined clip keeps the phases of the first", "[clip][edits]")
{
    Clip other = tone(0.7);
    other.bands.push_back({125.0, 140.0, 160.0, 0, {{0.0, 0.5}}, {}, 0.6});
    const auto joined = joinClips(tone(0.3), other);
    REQUIRE(joined.ok());
    REQUIRE(joined->bands.size() == 2);
    CHECK(joined->bands[0].phase == 0.3);
    CHECK(joined->bands[1].phase == 0.0);
}

TEST_CASE("A phase outside of 0 to 1 cycles is an error at its place", "[clip]")
{
    for (const double phase : {-0.1, 1.5, 1e9, std::nan(""), HUGE_VAL})
    {
        const auto valid = validate(tone(phase));
        REQUIRE_FALSE(valid.ok());
        CHECK(valid.error().where == "bands[0].phase");
    }
    CHECK(validate(tone(1.0)).ok());
}

TEST_CASE("Packing keeps phases to a tenth of a degree, in a version that older programs refuse", "[clip]")
{
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u})
    {
        CAPTURE(seed);
        Clip clip = test::randomClip(seed);
        const auto without = packClip(clip);
        CHECK(static_cast<int>(without[4]) == 1);
        Random random(seed);
        for (Band& band : clip.bands)
            band.phase = random.uniform();
        const bool any = !clip.bands.empty();
        const auto bytes = packClip(clip);
        CHECK(static_cast<int>(bytes[4]) == (any ? 2 : 1));
        CHECK(bytes.size() <= without.size() + (clip.bands.size() * 12 + 15) / 8);
        const auto read = unpackClip(bytes);
        REQUIRE(read.ok());
        for (std::size_t k = 0; k < clip.bands.size(); ++k)
            CHECK(std::abs(std::remainder(read->bands[k].phase - clip.bands[k].phase, 1.0)) <= 1.0 / 8192.0);
        CHECK(packClip(*read) == bytes);
        CHECK(onGrids(clip).bands == read->bands);
        for (Band& band : clip.bands)
            band.phase = 0.0;
        CHECK(packClip(clip) == without);
    }
    // What rounds to a whole cycle is no phase.
    CHECK(packClip(tone(0.99999)) == packClip(tone(0.0)));
    CHECK(packClip(tone(1.0)) == packClip(tone(0.0)));
}

TEST_CASE("Damaged phases are an error or valid", "[clip]")
{
    Clip clip = test::randomClip(3);
    for (Band& band : clip.bands)
        band.phase = 0.4;
    const auto bytes = packClip(clip);
    for (std::size_t cut = 0; cut < bytes.size(); ++cut)
        if (const auto read = unpackClip(std::span(bytes).first(cut)); read.ok())
            CHECK(validate(*read).ok());
    auto older = bytes; // as if it had none
    older[4] = std::byte{1};
    const auto read = unpackClip(older);
    REQUIRE(read.ok());
    for (const Band& band : read->bands)
        CHECK(band.phase == 0.0);
}

TEST_CASE("Phases leave stiff bodies and sharp filters stable from 8 to 768 kHz", "[synthesis][stability]")
{
    // Springs of 1e12 N/m, a resonance of q 1e4: phase may change the start of a sound, not its size.
    for (const double fs : {8000.0, 48000.0, 768000.0})
    {
        std::vector<double> largest;
        for (const double phase : {0.0, 0.123, 0.25, 0.5, 0.999})
        {
            CAPTURE(fs, phase);
            auto drive = test::played(tone(phase), fs);
            float peak = 0.0f;
            for (const float x : drive)
                peak = std::max(peak, std::abs(x));
            CHECK(peak < 0.55f);
            BodyParams body;
            body.jointStiffness = 1e12;
            BodyModel model;
            model.setParams({body, Resonance{100.0, 1e4}, BodyPoint::device, BodyForce::coil, Decibels(-300.0)});
            model.prepare({fs, drive.size()});
            model.process(drive, drive);
            double most = 0.0;
            for (const float x : drive)
            {
                REQUIRE(std::isfinite(x));
                most = std::max(most, std::abs(static_cast<double>(x)));
            }
            largest.push_back(most);
        }
        const auto [least, most] = std::minmax_element(largest.begin(), largest.end());
        CHECK(*most < 3.0 * *least + 1e-6);
    }
}
