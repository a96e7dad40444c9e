// The clip that was worked on is shown again after a crash and when its project is opened again.

#include "document/ProjectEdits.h"
#include "editor/Bench.h"
#include "editor/clip/session/ClipSteps.h"
#include "support/TempFolder.h"

using namespace pacini;
using namespace pacini::test;

namespace
{
/// Adds three clips and works on the second: a range is selected, the playhead stands in it, the view is zoomed in.
int workOnSecond(editor::Session& session)
{
    for (const char* name : {"knock_wood_bridge", "drums_tabla_pattern", "iter_drum_roll"})
    {
        auto imported = editor::importFile(demoSound(name), EncoderParams{});
        REQUIRE(imported.ok());
        session.sounds.add(std::move(imported).value());
    }
    const int second = session.model.document().project().clips[1]->id;
    session.model.show(second);
    session.clipSelection.setTimeRange(TimeRange{1.0, 2.0});
    session.transport.setPlayhead(1.25);
    session.viewState.showRange({0.5, 2.5});
    editor::editClip(session.model, "Gain", GainEdit{{}, -6.0});
    return second;
}

void checkPlace(editor::Session& session, int second)
{
    CHECK(session.model.activeId() == second);
    CHECK(session.transport.playhead() == Approx(1.25));
    CHECK(session.clipSelection.timeRange() == std::optional(TimeRange{1.0, 2.0}));
    const auto seen = session.viewState.axis().visible(session.viewState.viewWidth());
    CHECK(seen.from == Approx(0.5));
    CHECK(seen.to == Approx(2.5));
}
} // namespace

TEST_CASE("What is restored shows the clip that was worked on, with its range, playhead and view")
{
    const TempFolder folder;
    const juce::ScopedJuceInitialiser_GUI gui;
    int second = 0;
    {
        editor::Session session({folder.path() / "recovery", {}}, {});
        second = workOnSecond(session);
    }
    editor::Session session({folder.path() / "recovery", {}}, {});
    const auto offered = session.model.recoverable();
    REQUIRE(offered.size() == 1);
    REQUIRE(session.model.recover(offered.front()).ok());
    checkPlace(session, second);
    // A second crash before anything was done loses nothing of it.
    CHECK(session.model.document().isDirty());
}

TEST_CASE("A project that is opened again shows the clip that was worked on; another program's shows its first")
{
    const TempFolder folder;
    const juce::ScopedJuceInitialiser_GUI gui;
    const auto file = folder.path() / "p.pacini";
    int second = 0;
    {
        editor::Session session({{}, folder.path() / "recent.json"}, {});
        second = workOnSecond(session);
        REQUIRE(session.model.saveAs(file).ok());
    }
    {
        editor::Session session({{}, folder.path() / "recent.json"}, {});
        REQUIRE(session.model.openProject(file).ok());
        checkPlace(session, second);
        // Another project in between, in the same window.
        session.model.newProject();
        REQUIRE(session.model.openProject(file).ok());
        checkPlace(session, second);
        // The clip may have gone since.
        REQUIRE(session.model.change(
            [&](Document& document) { return document.commit("Remove", withoutClips(document.project(), {second})); }));
        REQUIRE(session.model.saveAs(folder.path() / "q.pacini").ok());
    }
    editor::Session fresh({{}, folder.path() / "other.json"}, {});
    REQUIRE(fresh.model.openProject(file).ok());
    CHECK(fresh.model.activeId() == fresh.model.document().project().clips.front()->id);
    CHECK(fresh.transport.playhead() == 0.0);
    CHECK_FALSE(fresh.clipSelection.timeRange());
}
