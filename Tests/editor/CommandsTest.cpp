// Commands: found by their words, in context menus, by keys, and what the newest of them do.

#include "editor/Bench.h"
#include "editor/Pump.h"
#include "editor/Translation.h"
#include "editor/clip/commands/ContextMenu.h"
#include "editor/clip/commands/KeyText.h"
#include "editor/clip/sheets/CommandSheet.h"
#include "editor/clip/sheets/OperationSheet.h"

#include <pacini/synthesis/Transparency.h>

#include <set>

using namespace pacini;
using namespace pacini::test;

namespace
{
std::vector<editor::Command> foundBy(EditorBench& bench, const juce::String& words)
{
    editor::CommandSheet sheet(bench.view.menus());
    sheet.setBounds(0, 0, 800, 600);
    auto& field = get<juce::TextEditor>(sheet, "Find a command");
    field.setText(words, false);
    field.onTextChange();
    return sheet.found();
}

/// The items of a menu with their texts.
std::vector<juce::PopupMenu::Item> itemsOf(const juce::PopupMenu& menu)
{
    std::vector<juce::PopupMenu::Item> items;
    for (juce::PopupMenu::MenuItemIterator next(menu); next.next();)
        if (!next.getItem().isSeparator)
            items.push_back(next.getItem());
    return items;
}
} // namespace

TEST_CASE("Commands are found by the beginnings of their words, in English and in the user's language")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    CHECK(foundBy(bench, "split").front() == editor::splitClipHere);
    CHECK(foundBy(bench, "exp").front() == editor::exportClips);
    CHECK(foundBy(bench, "zoom ran").front() == editor::zoomToRange);
    CHECK(foundBy(bench, "no such command").empty());
    std::set<editor::Command> all;
    std::size_t known = 0;
    for (const auto& menu : bench.view.menus().all())
        for (const auto& action : menu.actions)
            known += action.run ? 1u : 0u;
    CHECK(foundBy(bench, "").size() == known);
    editor::useLanguage("de");
    CHECK(foundBy(bench, "teilen").front() == editor::splitClipHere);
    CHECK(foundBy(bench, "split").front() == editor::splitClipHere);
    editor::useLanguage("en");
}

TEST_CASE("What cannot be done now is found behind what can")
{
    EditorBench bench;
    const auto found = foundBy(bench, "clip");
    const auto place = [&](editor::Command command)
    {
        return std::find(found.begin(), found.end(), command) - found.begin();
    };
    REQUIRE(place(editor::removeClip) < static_cast<std::ptrdiff_t>(found.size()));
    CHECK(place(editor::openFile) < place(editor::nextClip));
}

TEST_CASE("Every command has a key, or is found by words, and no key has two commands")
{
    EditorBench bench;
    std::set<juce::String> keys;
    for (const auto& menu : bench.view.menus().all())
        for (const auto& action : menu.actions)
        {
            CAPTURE(juce::String(action.name).toStdString());
            for (const auto& key : action.keys)
                CHECK(keys.insert(key.getTextDescription()).second);
            CHECK((!action.keys.empty() || !action.run ||
                   !foundBy(bench, editor::Menus::nameOf(action).upToFirstOccurrenceOf(juce::String::fromUTF8("…"),
                                                                                       false, false))
                        .empty()));
        }
    CHECK(bench.view.keyPressed(juce::KeyPress('x')) == false);
}

TEST_CASE("Keys are shown with symbols and in the user's language")
{
    using Key = juce::KeyPress;
    const juce::ScopedJuceInitialiser_GUI gui;
    const auto ctrlShift = juce::ModifierKeys::commandModifier | juce::ModifierKeys::shiftModifier;
#if !JUCE_MAC
    CHECK(editor::keyText(Key('z', ctrlShift, 0)) == "Ctrl+Shift+Z");
    CHECK(editor::keyText(Key(Key::leftKey, juce::ModifierKeys::commandModifier, 0)) ==
          juce::String::fromUTF8("Ctrl+←"));
    CHECK(editor::keyText(Key(Key::spaceKey)) == "Space");
    CHECK(editor::keyText(Key(Key::F1Key, juce::ModifierKeys::shiftModifier, 0)) == "Shift+F1");
    CHECK(editor::keyText(Key()).isEmpty());
    editor::useLanguage("de");
    CHECK(editor::keyText(Key('z', ctrlShift, 0)) == "Strg+Umschalt+Z");
    CHECK(editor::keyText(Key(Key::pageDownKey)) == "Bild ab");
    editor::useLanguage("en");
#endif
}

TEST_CASE("Lanes, sound, ruler, overview and actuator have menus whose commands are those of the menu bar")
{
    EditorBench bench({shipped("lra-175")});
    bench.openDemo("drums_tabla_pattern");
    std::size_t menus = 0;
    const auto visit = [&](auto& self, juce::Component& part) -> void
    {
        if (const auto* found = dynamic_cast<const editor::ContextMenu*>(&part))
        {
            ++menus;
            std::size_t wanted = 0;
            for (const auto command : found->contextCommands())
                wanted += command != editor::ContextMenu::menuLine ? 1u : 0u;
            const auto items = itemsOf(bench.view.menus().menuOf(found->contextCommands()));
            CHECK(items.size() == wanted);
            CHECK(wanted >= 4);
        }
        for (auto* child : part.getChildren())
            self(self, *child);
    };
    visit(visit, bench.view);
    CHECK(menus >= 8);
}

TEST_CASE("A right click keeps the selection that its menu is for")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    REQUIRE(bench.view.doCommand(editor::selectAll));
    const Selection before = bench.session.clipSelection.selected();
    auto& row = bench.row(envelope);
    Mouse right(row, juce::ModifierKeys::rightButtonModifier);
    right.press(row.plotArea().getBottomRight().toFloat() - juce::Point<float>(3.0f, 3.0f));
    CHECK(bench.session.clipSelection.selected() == before);
}

TEST_CASE("Taps of one pass are one step, wherever they are")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    const Clip before = bench.clip();
    auto& transport = bench.session.transport;
    transport.setPlayhead(0.9 * before.duration);
    REQUIRE(bench.view.doCommand(editor::tapEvent));
    CHECK(bench.clip().transients.size() == before.transients.size() + 1);
    transport.setPlayhead(0.7 * before.duration);
    REQUIRE(bench.view.doCommand(editor::tapEvent));
    CHECK(bench.clip().transients.size() == before.transients.size() + 2);
    // Nothing plays: each is a step of its own.
    bench.session.model.undo();
    CHECK(bench.clip().transients.size() == before.transients.size() + 1);
    bench.session.model.undo();
    CHECK(bench.clip() == before);
}

TEST_CASE("A clip that is fitted to an actuator lies within its range, in one step that is undone")
{
    EditorBench bench({shipped("lra-175")});
    bench.openDemo("drums_tabla_pattern");
    CHECK_FALSE(bench.view.doCommand(editor::fitToActuator)); // to none
    bench.session.actuators.setProfile("lra-175");
    const Clip before = bench.clip();
    const std::size_t steps = bench.session.model.document().steps().size();
    REQUIRE(bench.view.doCommand(editor::fitToActuator));
    CHECK(bench.session.model.document().steps().size() == steps + 1);
    const Clip fitted = bench.clip();
    CHECK_FALSE(fitted == before);
    CHECK(fitted.duration == before.duration);
    CHECK(fitted.bands.size() <= before.bands.size());
    bench.session.model.undo();
    CHECK(bench.clip() == before);
}

TEST_CASE("A clip feels on the chosen actuator as on another it was designed on, as render --designed-for makes it")
{
    EditorBench bench({shipped("lra-175"), shipped("l5-wristband"), shipped("erm-coin")});
    bench.openDemo("drums_tabla_pattern");
    CHECK_FALSE(bench.view.doCommand(editor::feelAlike)); // no actuator is chosen
    bench.session.actuators.setProfile("erm-coin");
    CHECK_FALSE(bench.view.doCommand(editor::feelAlike)); // a motor plays no frequencies
    bench.session.actuators.setProfile("l5-wristband");
    const Clip before = bench.clip();
    const std::size_t steps = bench.session.model.document().steps().size();
    REQUIRE(bench.view.doCommand(editor::feelAlike));
    auto* sheet = dynamic_cast<editor::OperationSheet*>(bench.view.sheet());
    REQUIRE(sheet != nullptr);
    AdaptationParams params;
    params.strength = bench.session.actuators.strength();
    const auto wanted = transparentClip(before, *shipped("lra-175").profile, *shipped("l5-wristband").profile, params);
    REQUIRE(wanted);
    CHECK(bench.clip() == wanted->clip); // the preview
    sheet->apply();
    bench.view.showSheet(nullptr);
    CHECK(bench.clip() == wanted->clip);
    CHECK(bench.session.model.document().steps().size() == steps + 1);
    bench.session.model.undo();
    CHECK(bench.clip() == before);
}

TEST_CASE("Next and previous clip go round the project")
{
    EditorBench bench;
    for (const char* name : {"knock_wood_bridge", "impact_boom", "click_clock"})
        bench.openDemo(name);
    const int last = bench.session.model.activeId();
    REQUIRE(bench.view.doCommand(editor::nextClip));
    const int first = bench.session.model.activeId();
    CHECK(first != last);
    REQUIRE(bench.view.doCommand(editor::previousClip));
    CHECK(bench.session.model.activeId() == last);
    REQUIRE(bench.view.doCommand(editor::previousClip));
    CHECK(bench.session.model.activeId() != first);
}

TEST_CASE("Keys can be changed: in the list of shortcuts, for menus and search, and kept for the next start")
{
    using Key = juce::KeyPress;
    const auto ctrlJ = Key('j', juce::ModifierKeys::commandModifier, 0);
    EditorBench bench;
    auto& menus = bench.view.menus();
    CHECK(menus.changedKeys() == nullptr);
    REQUIRE(bench.view.doCommand(editor::shortcuts));
    auto& table = get<juce::Component>(*bench.view.sheet(), "Keyboard and mouse");
    auto& list = *dynamic_cast<juce::Viewport*>(bench.view.sheet()->getChildComponent(0))->getViewedComponent();
    juce::ignoreUnused(table);
    CHECK(list.keyPressed(Key(Key::downKey)));   // the first command: new project
    CHECK(list.keyPressed(Key(Key::returnKey))); // waits
    CHECK(list.keyPressed(Key(Key::leftKey)));   // lanes need it
    CHECK(menus.commandOf(Key(Key::leftKey)) == std::nullopt);
    CHECK(list.keyPressed(ctrlJ));
    CHECK(menus.commandOf(ctrlJ) == editor::newProject);
    CHECK(menus.keyTextOf(editor::newProject) == editor::keyText(ctrlJ));
    CHECK(menus.commandOf(Key('n', juce::ModifierKeys::commandModifier, 0)) == std::nullopt);
    CHECK_FALSE(list.keyPressed(Key('x')));
    // A key has one command.
    menus.setKey(editor::openFile, ctrlJ);
    CHECK(menus.commandOf(ctrlJ) == editor::openFile);
    CHECK(menus.keysOf(editor::newProject).empty());
    const auto changed = menus.changedKeys();
    REQUIRE(changed != nullptr);
    EditorBench next;
    next.view.menus().restoreKeys(*changed);
    CHECK(next.view.menus().commandOf(ctrlJ) == editor::openFile);
    CHECK(next.view.menus().keysOf(editor::newProject).empty());
    CHECK_FALSE(next.view.menus().keysOf(editor::save).empty());
    next.view.menus().resetKeys();
    CHECK(next.view.menus().changedKeys() == nullptr);
    CHECK(next.view.menus().keyTextOf(editor::newProject) ==
          editor::keyText(Key('n', juce::ModifierKeys::commandModifier, 0)));
}

TEST_CASE("Preferences are in the Edit menu and lead to the audio devices")
{
    EditorBench bench;
    bool isInEdit = false;
    for (const auto& menu : bench.view.menus().all())
        for (const auto& action : menu.actions)
            isInEdit = isInEdit || (action.id == editor::preferences && juce::String(menu.name) == "Edit");
    CHECK(isInEdit);
    editor::HostServices around;
    int shown = 0;
    around.showDevices = [&shown]
    {
        ++shown;
    };
    editor::EditorView view(bench.session, around);
    view.setBounds(0, 0, 1280, 800);
    REQUIRE(view.doCommand(editor::preferences));
    get<juce::TextButton>(*view.sheet(), "Audio").onClick();
    CHECK(pumpUntil([&] { return shown == 1; }));
}
