#include "document/Amendments.h"
#include "document/Analysis.h"
#include "document/Document.h"
#include "document/ProjectEdits.h"
#include "io/AudioWriter.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

#include <cmath>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// A sound of a second with markers.
StoredAudio markedSound(const std::vector<Marker>& markers)
{
    TempFolder folder;
    std::vector<float> samples(8000);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = 0.5f * std::sin(0.08f * static_cast<float>(i));
    AudioWriteParams params;
    params.sampleRate = 8000;
    params.markers = markers;
    REQUIRE(writeAudio(folder / "door.wav", samples, params));
    auto sound = StoredAudio::read(folder / "door.wav");
    REQUIRE(sound);
    return std::move(*sound);
}

AudioReference markedReference()
{
    AudioReference sound;
    sound.path = "door.wav";
    return sound;
}

Clip markedAnalysis(const StoredAudio& sound, const EncoderParams& params = {})
{
    auto clip = analyse(sound, params, markedReference());
    REQUIRE(clip);
    return *clip;
}
} // namespace

TEST_CASE("An analysis has the markers of its sound, and the clip keeps them when it is analysed anew", "[document]")
{
    const auto sound = markedSound({{0.25, "hit"}, {0.5, "ring"}});
    EncoderParams finer;
    finer.bands = 10;
    Document document;
    const auto id = addSound(document, markedReference(), {}, markedAnalysis(sound));
    REQUIRE(id);
    REQUIRE(document.clip(*id)->clip->markers.size() == 2);
    CHECK(document.clip(*id)->clip->markers[0].name == "hit");
    CHECK(document.clip(*id)->clip->markers[0].time == Approx(0.25).margin(0.001));
    REQUIRE(document.commit("Finer", withAnalysis(document.project(), finer, {*id, markedAnalysis(sound, finer)},
                                                  document.steps().newIds().source)));
    CHECK(document.clip(*id)->clip->markers.size() == 2);
}

TEST_CASE("Markers that a clip has besides its sound's are kept when it is analysed anew", "[document]")
{
    const auto bare = markedSound({});
    Clip labelled = markedAnalysis(bare);
    labelled.markers = {{0.25, "label"}, {0.75, "late"}};
    Document document;
    const auto id = addSound(document, markedReference(), {}, labelled);
    REQUIRE(id);
    const auto changed = markedSound({{0.5, "new"}});
    REQUIRE(document.commit("Again", withAnalysis(document.project(), {}, {*id, markedAnalysis(changed)},
                                                  document.steps().newIds().source)));
    const auto markers = document.clip(*id)->clip->markers;
    REQUIRE(markers.size() == 3);
    CHECK(markers[0].name == "label");
    CHECK(markers[1].name == "new");
    CHECK(markers[2].name == "late");
    // Another sound brings its own.
    REQUIRE(
        document.commit("Other", withAnalysis(document.project(), {}, {*id, markedAnalysis(changed), markedReference()},
                                              document.steps().newIds().source)));
    CHECK(document.clip(*id)->clip->markers.size() == 1);
}
