// Undo in the editor: what it takes back, what is shown then, and how its steps are called.

#include "editor/Bench.h"
#include "editor/Translation.h"
#include "editor/clip/session/ClipSteps.h"
#include "editor/clip/session/StepText.h"
#include "editor/clip/sheets/HistorySheet.h"

using namespace pacini;
using namespace pacini::test;

namespace
{
Clip plainClip(const std::string& name, double duration)
{
    Clip clip;
    clip.name = name;
    clip.duration = duration;
    for (int i = 0; i <= 10; ++i)
        clip.envelope.push_back({0.1 * i * duration, 0.5});
    return clip;
}

/// Three clips of 1, 2 and 3 s; the last one is shown.
struct HistoryBench : EditorBench
{
    HistoryBench()
    {
        for (const double duration : {1.0, 2.0, 3.0})
        {
            editor::Imported imported;
            imported.clip = plainClip(std::to_string(static_cast<int>(duration)), duration);
            session.sounds.add(std::move(imported));
        }
    }

    [[nodiscard]] std::string shown() { return session.model.clip() ? session.model.clip()->name : ""; }
    [[nodiscard]] const Document& document() { return session.model.document(); }
    void show(std::size_t index) { session.model.show(document().project().clips[index]->id); }

    [[nodiscard]] juce::String menuText(const char* menuName, int command)
    {
        for (const editor::Menu& menu : view.menus().all())
            for (const editor::Action& action : menu.actions)
                if (menu.name == std::string(menuName) && action.id == command)
                    return action.fullName ? action.fullName() : juce::String(action.name);
        return {};
    }
};
} // namespace

TEST_CASE("Undo does not empty a project of sounds that were only opened")
{
    HistoryBench bench;
    CHECK_FALSE(bench.view.doCommand(editor::undo));
    CHECK(bench.document().project().clips.size() == 3);
    CHECK(bench.menuText("Edit", editor::undo) == "Undo");
}

TEST_CASE("Undo and redo show the clip that they change, with the playhead inside of it")
{
    HistoryBench bench;
    auto& model = bench.session.model;
    bench.show(0);
    REQUIRE(editor::editClip(model, "Reverse", ReverseEdit{}));
    REQUIRE(editor::editClip(model, "Repeat", RepeatEdit{3}));
    bench.session.transport.setPlayhead(2.5);
    model.undo();
    CHECK(bench.shown() == "1");
    CHECK(bench.session.transport.playhead() <= 1.0);
    bench.show(2);
    bench.session.transport.setPlayhead(2.5);
    model.undo();
    CHECK(bench.shown() == "1");
    CHECK(bench.session.transport.playhead() == 0.0);
    bench.show(1);
    model.redo();
    CHECK(bench.shown() == "1");
    CHECK(bench.session.transport.playhead() == 0.0);
}

TEST_CASE("Undo of a copy shows what stands in its place, redo the copy; a removed clip comes back into view")
{
    HistoryBench bench;
    auto& model = bench.session.model;
    bench.show(1);
    editor::duplicateShown(model);
    const int copy = model.activeId();
    model.undo();
    CHECK(bench.shown() == "3");
    model.redo();
    CHECK(model.activeId() == copy);
    editor::removeClips(model, {model.activeId()});
    CHECK(model.activeId() != copy);
    model.undo();
    CHECK(model.activeId() == copy);
}

TEST_CASE("Steps say what they change and how much of it, in the menu and in German")
{
    HistoryBench bench;
    auto& selection = bench.session.clipSelection;
    selection.select(withPoints({}, envelope, {2, 3, 4}));
    selection.deleteSelection();
    CHECK(bench.document().steps().undoName() == "Delete 3 points");
    CHECK(bench.menuText("Edit", editor::undo) == "Undo delete 3 points");
    bench.view.doCommand(editor::undo);
    CHECK(bench.menuText("Edit", editor::redo) == "Redo delete 3 points");
    Selection both = withPoints({}, envelope, {1});
    CHECK(editor::stepName(editor::SelectionStep::move, both) == "Move point");
    both.transients = {0, 1};
    CHECK(editor::stepName(editor::SelectionStep::move, both) == "Move 3 points and events");
    both.lanes.clear();
    CHECK(editor::stepName(editor::SelectionStep::move, both) == "Move 2 events");
    editor::useLanguage("de");
    CHECK(bench.menuText("Edit", editor::redo) == juce::String::fromUTF8("Wiederholen: 3 Punkte l\xc3\xb6schen"));
    CHECK(editor::stepText("Move 12 events") == "12 Ereignisse verschieben");
    editor::useLanguage("en");
}

TEST_CASE("The list of steps goes to any of them, and stays open")
{
    HistoryBench bench;
    auto& model = bench.session.model;
    CHECK_FALSE(bench.view.doCommand(editor::showHistory));
    for (int i = 0; i < 5; ++i)
        REQUIRE(editor::editClip(model, "Gain", GainEdit{{}, -1.0}));
    const Clip last = bench.clip();
    REQUIRE(bench.view.doCommand(editor::showHistory));
    REQUIRE(bench.view.sheet() != nullptr);
    auto& list = get<juce::ListBox>(*bench.view.sheet(), "Steps");
    auto* rows = list.getModel();
    CHECK(rows->getNumRows() == 6);
    CHECK(rows->getNameForRow(0) == "As opened");
    CHECK(rows->getNameForRow(5) == "Gain");
    CHECK(list.getSelectedRow() == 5);
    list.selectRow(0);
    CHECK(bench.clip() == plainClip("3", 3.0));
    list.selectRow(5);
    CHECK(bench.clip() == last);
    list.selectRow(2);
    model.undo();
    CHECK(list.getSelectedRow() == 1);
    CHECK(bench.view.sheet() != nullptr);
}
