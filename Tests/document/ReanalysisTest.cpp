#include "document/Analysis.h"
#include "document/EditText.h"
#include "io/EncoderPresets.h"
#include "support/Catch.h"

#include <cmath>
#include <numbers>
#include <set>

using namespace pacini;

namespace
{
StoredAudio tone(double duration)
{
    AudioData audio;
    audio.sampleRate = 48000;
    audio.channels = 2;
    audio.samples.resize(2 * static_cast<std::size_t>(duration * 48000.0));
    for (std::size_t i = 0; i < audio.samples.size(); ++i)
        audio.samples[i] =
            static_cast<float>(0.5 * std::sin(2.0 * std::numbers::pi * 200.0 * static_cast<double>(i / 2) / 48000.0));
    return StoredAudio(audio);
}

std::string titleOf(EditOperation operation)
{
    return editTitle({std::move(operation), {}, 4.0});
}
} // namespace

TEST_CASE("An analysis tells its progress from 0 upwards and gives the same clip as one that is not asked")
{
    const StoredAudio audio = tone(6.0);
    std::vector<double> told;
    const auto watched = analyse(audio, {}, {},
                                 [&](double done)
                                 {
                                     told.push_back(done);
                                     return true;
                                 });
    REQUIRE(watched);
    CHECK(*watched == analyse(audio, {}, {}).value());
    REQUIRE(told.size() >= 4);
    CHECK(told.front() == 0.0);
    CHECK(std::is_sorted(told.begin(), told.end()));
    CHECK(told.back() > 0.5);
    CHECK(told.back() <= 1.0);
}

TEST_CASE("An analysis that is stopped ends there, whenever that is")
{
    const StoredAudio audio = tone(6.0);
    for (const int last : {0, 1, 3})
    {
        int asked = 0;
        const auto stopped = analyse(audio, {}, {}, [&](double) { return asked++ < last; });
        REQUIRE_FALSE(stopped);
        CHECK(stopped.error().code == ErrorCode::cancelled);
        CHECK(asked == last + 1);
    }
}

TEST_CASE("Presets of the analysis are valid, differ, and the first is the usual one")
{
    std::set<std::string_view> names;
    for (const EncoderPreset& preset : encoderPresets())
    {
        INFO(preset.name);
        CHECK(validate(preset.params));
        CHECK(names.insert(preset.name).second);
        CHECK(presetOf(preset.params) == &preset);
    }
    CHECK(encoderPresets().front().params == EncoderParams{});
    EncoderParams own;
    own.bands = 13;
    CHECK(presetOf(own) == nullptr);
}

TEST_CASE("Edits say what they do and where")
{
    const TimeRange range{1.0, 2.0};
    const Edit points{LanePatch{{LaneKind::amplitude, 3}, range, {}}, {119.6}, 4.0};
    CHECK(editTitle(points) == "Points of the band at 120 Hz");
    CHECK(editTime(points) == range);
    CHECK(titleOf(LanePatch{{LaneKind::envelope, 0}, range, {}}) == "Points of the envelope");
    CHECK(titleOf(LanePatch{{LaneKind::pitch, 1}, range, {}}) == "Points of the pitch of band 2");
    CHECK(titleOf(TransientPatch{std::nullopt, Transient{1.5, 1.0, 0.5}}) == "Event added");
    CHECK(titleOf(TransientPatch{Transient{1.5, 1.0, 0.5}, std::nullopt}) == "Event removed");
    CHECK(titleOf(GainEdit{{}, -3.0}) == "Gain of -3.0 dB");
    CHECK(titleOf(FadeEdit{{}, FadeDirection::out, FadeShape::linear}) == "Fade out");
    CHECK(titleOf(StretchEdit{1.5}) == "Stretched to 150 %");
    CHECK(editTime({TransientPatch{Transient{1.5, 1.0, 0.5}, std::nullopt}, {}, 4.0}) == TimeRange{1.5, 1.5});
    CHECK(editTime({TransientPatch{std::nullopt, Transient{2.5, 1.0, 0.5}}, {}, 4.0}) == TimeRange{2.5, 2.5});
    CHECK(editTime({GainEdit{{range, true, {}, true}, 3.0}, {}, 4.0}) == range);
    // The whole clip is no place.
    CHECK_FALSE(editTime({GainEdit{{{0.0, 4.0}, true, {}, true}, 3.0}, {}, 4.0}));
    CHECK_FALSE(editTime({ReverseEdit{}, {}, 4.0}));
}
