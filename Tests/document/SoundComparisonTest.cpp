// Comparison of a clip with its sound.

#include "document/SoundComparison.h"

#include "document/Analysis.h"
#include "support/Catch.h"

#include <cmath>
#include <numbers>

using namespace pacini;

namespace
{
StoredAudio twoTones(double second)
{
    AudioData audio{48000, 1, {}, 0, {}};
    for (int i = 0; i < 2 * 48000; ++i)
    {
        const double t = i / 48000.0;
        audio.samples.push_back(
            static_cast<float>(0.3 * std::sin(2.0 * std::numbers::pi * 100.0 * t) +
                               (t > 1.0 ? second * std::sin(2.0 * std::numbers::pi * 400.0 * t) : 0.0)));
    }
    return StoredAudio(audio);
}

const std::atomic<bool> goesOn{false};
} // namespace

TEST_CASE("A clip of its own sound differs little from it, and what is missing is seen where it is missing")
{
    const StoredAudio audio = twoTones(0.3);
    const Clip clip = analyse(audio, {}, {}).value();
    const auto whole = compareWithSound(clip, audio, goesOn);
    REQUIRE(whole);
    const auto& found = *whole;
    CHECK(found.duration == Approx(2.0).margin(0.01));
    CHECK(found.difference.size() == SoundComparison::columns * found.rows.count);
    CHECK(found.score > 60.0);
    CHECK(found.score <= found.best + 1.0);
    REQUIRE(found.match);
    const auto rowAt = [&](double frequency)
    {
        return static_cast<std::size_t>(found.rows.placeOf(frequency));
    };
    CHECK(found.differenceOfRows[rowAt(100.0)] < 4.0);

    // Without its upper bands the second tone is missing in the second half.
    Clip poorer = clip;
    std::erase_if(poorer.bands, [](const Band& band) { return band.centreFrequency > 250.0; });
    const auto less = compareWithSound(poorer, audio, goesOn);
    REQUIRE(less);
    const auto at = [&](double share)
    {
        return less
            ->difference[static_cast<std::size_t>(share * SoundComparison::columns) * found.rows.count + rowAt(400.0)];
    };
    CHECK(at(0.75) < -15.0f);
    CHECK(std::abs(at(0.25)) < 6.0f);
    CHECK(less->score < found.score);
}

TEST_CASE("A comparison that is cancelled says so, and one of silence no predicted match")
{
    const std::atomic<bool> cancelled{true};
    const StoredAudio audio = twoTones(0.1);
    const Clip clip = analyse(audio, {}, {}).value();
    const auto none = compareWithSound(clip, audio, cancelled);
    REQUIRE_FALSE(none);
    CHECK(none.error().code == ErrorCode::cancelled);
    AudioData silent{48000, 1, std::vector<float>(48000), 0, {}};
    const auto quiet = compareWithSound(clip, StoredAudio(silent), goesOn);
    REQUIRE(quiet);
    CHECK_FALSE(quiet->match);
}
