// The project that the editor opens when it runs for the first time.

#include "document/Amendments.h"
#include "document/Analysis.h"
#include "document/AudioReference.h"
#include "document/Document.h"
#include "document/ProjectEdits.h"
#include "support/Catch.h"
#include "support/Paths.h"

#include <pacini/clip/edits/RangeEdits.h>

#include <filesystem>
#include <set>
#include <string>

using namespace pacini;

namespace
{
std::filesystem::path demoFolder()
{
    return sourceFolder() / "Resources/demo";
}

int addDemo(Document& document, const std::string& file)
{
    auto sound = describeAudio(demoFolder() / file).value();
    Clip clip = analyse(sound.audio, {}, sound.reference).value();
    return addSound(document, sound.reference, {}, std::move(clip)).value();
}

EditScope wholeClip(const Document& document, int id)
{
    EditScope scope;
    scope.range = {0.0, document.clip(id)->clip->duration};
    scope.allLanes = true;
    return scope;
}
} // namespace

TEST_CASE("Make the sample project", "[.make-sample]")
{
    Document document;
    const int knock = addDemo(document, "knock_wood_bridge.flac");
    const int boom = addDemo(document, "impact_boom.flac");
    const int guitar = addDemo(document, "pluck_guitar_harmonics.flac");
    REQUIRE(document.commit(
        "Markers", withEdit(document.project(), knock, MarkersEdit{{{0.0, "First knock"}, {0.25, "Second knock"}}})));
    REQUIRE(document.commit("Gain", withEdit(document.project(), boom, GainEdit{wholeClip(document, boom), -3.0})));
    REQUIRE(document.commit("Fade out",
                            withEdit(document.project(), boom,
                                     FadeEdit{wholeClip(document, boom), FadeDirection::out, FadeShape::linear})));
    REQUIRE(document.commit("Groups", withGroups(document.project(), {"Impacts", "Music"})));
    REQUIRE(document.commit("Group", withGroup(document.project(), {knock}, "Impacts")));
    REQUIRE(document.commit("Group", withGroup(document.project(), {boom}, "Impacts")));
    REQUIRE(document.commit("Group", withGroup(document.project(), {guitar}, "Music")));
    REQUIRE(
        document.commit("Notes", withNotes(document.project(), knock,
                                           "Two knocks on wood. Drag an event up or down, then press the space bar.")));
    REQUIRE(document.commit(
        "Notes", withNotes(document.project(), boom,
                           "Softer by 3 dB and faded out by hand. Change something on the Analysis page: both "
                           "edits stay.")));
    REQUIRE(
        document.commit("Notes", withNotes(document.project(), guitar,
                                           "Mostly bands. Try Simplify on the Edit page, and S and M beside a band.")));
    REQUIRE(document.commit(
        "Notes", withProjectNotes(document.project(),
                                  "A project to try things on. It is not saved anywhere until you save it.")));
    ProjectProfile profile;
    profile.name = "l5-wristband";
    REQUIRE(setProfile(document, std::move(profile)));
    REQUIRE(document.saveAs(demoFolder() / "sample.pacini"));
}

TEST_CASE("The sample project opens whole, with its sounds beside it and every hand edit in its place")
{
    const auto opened = Document::open(demoFolder() / "sample.pacini");
    REQUIRE(opened);
    const Project& project = opened->project();
    CHECK(project.clips.size() == 3);
    CHECK_FALSE(project.notes.empty());
    std::set<std::string> groups;
    for (const auto& item : project.clips)
    {
        CHECK(item->unfitting.empty());
        CHECK_FALSE(item->notes.empty());
        groups.insert(item->group);
        const AudioReference* sound = project.findSource(item->source);
        REQUIRE(sound != nullptr);
        const auto located = locateAudio(*sound, {});
        REQUIRE(located);
        CHECK_FALSE(located->changed);
        CHECK(located->path.parent_path() == demoFolder());
        // The edits change something.
        CHECK((item->edits.empty() || !(*item->clip == *item->analysis)));
    }
    CHECK(groups == std::set<std::string>{"Impacts", "Music"});
}
