// The project that the editor opens when it runs for the first time.

#include "document/Analysis.h"
#include "document/AudioReference.h"
#include "document/Document.h"
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
    return document.addSound(sound.reference, {}, std::move(clip)).value();
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
    REQUIRE(document.edit(knock, "Markers", MarkersEdit{{{0.0, "First knock"}, {0.25, "Second knock"}}}));
    REQUIRE(document.edit(boom, "Gain", GainEdit{wholeClip(document, boom), -3.0}));
    REQUIRE(
        document.edit(boom, "Fade out", FadeEdit{wholeClip(document, boom), FadeDirection::out, FadeShape::linear}));
    document.setGroups({"Impacts", "Music"}, "Groups");
    REQUIRE(document.setGroup(knock, "Impacts", "Group"));
    REQUIRE(document.setGroup(boom, "Impacts", "Group"));
    REQUIRE(document.setGroup(guitar, "Music", "Group"));
    REQUIRE(
        document.setNotes(knock, "Two knocks on wood. Drag an event up or down, then press the space bar.", "Notes"));
    REQUIRE(document.setNotes(boom,
                              "Softer by 3 dB and faded out by hand. Change something on the Analysis page: both "
                              "edits stay.",
                              "Notes"));
    REQUIRE(
        document.setNotes(guitar, "Mostly bands. Try Simplify on the Edit page, and S and M beside a band.", "Notes"));
    document.setProjectNotes("A project to try things on. It is not saved anywhere until you save it.", "Notes");
    ProjectProfile profile;
    profile.name = "l5-wristband";
    REQUIRE(document.setProfile(std::move(profile)));
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
