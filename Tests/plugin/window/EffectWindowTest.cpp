// What the window has as other effects do: undo, sides, presets of the user, menus of controls, scale, help.

#include "editor/ParameterMenu.h"
#include "editor/Pump.h"
#include "editor/Text.h"
#include "editor/Translation.h"
#include "editor/clip/sheets/HelpSheet.h"
#include "plugin/engine/FakePads.h"
#include "plugin/engine/Rig.h"
#include "plugin/window/PluginWindow.h"
#include "support/TempFolder.h"

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>

using namespace pacini;
using namespace pacini::test;
using plugin::ParameterId;

namespace
{
using WindowRig = RigOf<plugin::Plugin>;

void visitAll(juce::Component& parent, const std::function<void(juce::Component&)>& visit)
{
    for (juce::Component* child : parent.getChildren())
    {
        visit(*child);
        visitAll(*child, visit);
    }
}

template <typename Control>
Control& controlOf(juce::Component& window, const juce::String& title)
{
    Control* found = nullptr;
    visitAll(window,
             [&](juce::Component& child)
             {
                 if (auto* control = dynamic_cast<Control*>(&child); control && control->getTitle() == title)
                     found = control;
             });
    CAPTURE(title);
    REQUIRE(found != nullptr);
    return *found;
}

/// Does what a menu has under this text.
bool chooseFrom(const juce::PopupMenu& menu, const juce::String& text)
{
    for (juce::PopupMenu::MenuItemIterator each(menu, true); each.next();)
        if (each.getItem().text == text && each.getItem().isEnabled && each.getItem().action)
        {
            each.getItem().action();
            return true;
        }
    return false;
}

juce::StringArray textsOf(const juce::PopupMenu& menu)
{
    juce::StringArray texts;
    for (juce::PopupMenu::MenuItemIterator each(menu, true); each.next();)
        texts.add(each.getItem().text);
    return texts;
}

void answer(plugin::PluginWindow& window, const juce::String& text)
{
    REQUIRE(window.sheet() != nullptr);
    juce::TextButton* found = nullptr;
    for (juce::Component* child : window.sheet()->getChildren())
        if (auto* button = dynamic_cast<juce::TextButton*>(child); button && button->getButtonText() == text)
            found = button;
    REQUIRE(found != nullptr);
    found->onClick();
    pumpFor(0.02); // it closes
}

/// Answers the question for a name.
void name(plugin::PluginWindow& window, const juce::String& text)
{
    REQUIRE(window.sheet() != nullptr);
    juce::TextEditor* field = nullptr;
    for (juce::Component* child : window.sheet()->getChildren())
        if (auto* editor = dynamic_cast<juce::TextEditor*>(child))
            field = editor;
    REQUIRE(field != nullptr);
    field->setText(text);
    field->onReturnKey();
    pumpFor(0.02); // it closes
}

void turn(plugin::PluginWindow& window, const char* title, double place)
{
    controlOf<juce::Slider>(window, title).setValue(place, juce::sendNotificationSync);
}

juce::KeyPress undoKey()
{
    return {'z', juce::ModifierKeys::commandModifier, 0};
}
} // namespace

TEST_CASE("The window undoes and redoes by buttons, menu and keys")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    auto& undo = controlOf<juce::Button>(window, "Undo");
    auto& redo = controlOf<juce::Button>(window, "Redo");
    CHECK_FALSE(undo.isEnabled());
    const auto first = rig.plugin.values();
    turn(window, "Attack", 0.7);
    turn(window, "Release", 0.6);
    window.refresh();
    CHECK(undo.isEnabled());
    CHECK_FALSE(redo.isEnabled());
    const auto turned = rig.plugin.values();
    undo.onClick();
    CHECK(window.keyPressed(undoKey()));
    CHECK(rig.plugin.values() == first);
    CHECK_FALSE(undo.isEnabled());
    CHECK(controlOf<juce::Slider>(window, "Attack").getValue() ==
          Approx(static_cast<double>(rig.plugin.parameter(ParameterId::attack).getValue())));
    redo.onClick();
    CHECK(window.keyPressed({'z', juce::ModifierKeys::commandModifier | juce::ModifierKeys::shiftModifier, 0}));
    CHECK(rig.plugin.values() == turned);
    CHECK(chooseFrom(window.menu(), "Undo"));
    CHECK(chooseFrom(window.menu(), "Undo"));
    CHECK_FALSE(chooseFrom(window.menu(), "Undo"));
    CHECK(rig.plugin.values() == first);
}

TEST_CASE("The window switches between A and B, and copies one to the other")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    auto& a = controlOf<juce::TextButton>(window, "Side A");
    auto& b = controlOf<juce::TextButton>(window, "Side B");
    CHECK(a.getToggleState());
    turn(window, "Attack", 0.7);
    const auto atA = rig.plugin.values();
    b.onClick();
    window.refresh();
    CHECK(b.getToggleState());
    CHECK_FALSE(a.getToggleState());
    turn(window, "Attack", 0.2);
    const auto atB = rig.plugin.values();
    a.onClick();
    CHECK(rig.plugin.values() == atA);
    b.onClick();
    CHECK(rig.plugin.values() == atB);
    CHECK(textsOf(window.menu()).contains("Copy B to A"));
    a.onClick();
    CHECK(chooseFrom(window.menu(), "Copy A to B"));
    b.onClick();
    CHECK(rig.plugin.values() == atA);
}

TEST_CASE("Presets are saved, chosen and deleted in the menu of presets, and not replaced without a question")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    auto& box = controlOf<plugin::PresetBox>(window, "Preset");
    const auto choose = [&](const juce::String& text)
    {
        for (int i = 0; i < box.getNumItems(); ++i)
            if (box.getItemText(i) == text)
            {
                box.setSelectedId(box.getItemId(i), juce::sendNotificationSync);
                return true;
            }
        return false;
    };
    turn(window, "Attack", 0.7);
    const auto first = rig.plugin.values();
    REQUIRE(choose(juce::String::fromUTF8("Save preset…")));
    name(window, "Rain");
    CHECK(box.getText() == "Rain");
    turn(window, "Attack", 0.1);
    window.refresh();
    CHECK(box.getText() == "Rain *");
    const auto second = rig.plugin.values();
    box.save();
    name(window, "Rain");
    answer(window, "Cancel");
    CHECK(choose("Music"));
    CHECK(box.getText() == "Music");
    CHECK(choose("Rain"));
    CHECK(rig.plugin.values() == first);
    CHECK(window.keyPressed(undoKey()));
    CHECK(box.getText() == "Music");
    window.keyPressed(undoKey());
    CHECK(rig.plugin.values() == second);
    box.save();
    name(window, "Rain");
    answer(window, "Replace");
    CHECK(box.getText() == "Rain");
    // By arrows too, and never to what stands below the presets.
    for (int i = 0; i < 10; ++i)
        CHECK(box.keyPressed(juce::KeyPress(juce::KeyPress::upKey)));
    CHECK(box.getText() == "Neutral");
    for (int i = 0; i < 10; ++i)
        CHECK(box.keyPressed(juce::KeyPress(juce::KeyPress::downKey)));
    CHECK(box.getText() == "Rain");
    CHECK(window.sheet() == nullptr);
    box.save();
    name(window, "a/b");
    CHECK(window.sheet()->getTitle() == "Preset not saved");
    answer(window, "Close");
    // A window of another instance finds it; a broken file is named there and cannot be chosen.
    const auto folder = editor::pathOf(rig.plugin.userFolder().getChildFile("Presets"));
    put(folder / "broken.json", "{");
    {
        WindowRig other;
        other.plugin.setUserFolder(rig.plugin.userFolder());
        plugin::PluginWindow another(other.plugin);
        auto& theirs = controlOf<plugin::PresetBox>(another, "Preset");
        juce::StringArray offered;
        for (int i = 0; i < theirs.getNumItems(); ++i)
        {
            offered.add(theirs.getItemText(i));
            if (theirs.getItemText(i).startsWith("broken.json"))
                CHECK_FALSE(theirs.isItemEnabled(theirs.getItemId(i)));
        }
        CHECK(offered.contains("Rain"));
        CHECK(offered.joinIntoString("\n").contains("broken.json cannot be used: "));
        CHECK(theirs.getText() == "Neutral");
    }
    box.remove();
    answer(window, "Delete");
    CHECK_FALSE(std::filesystem::exists(folder / "Rain.json"));
    CHECK(rig.plugin.values().translator() == second.translator());
    CHECK_FALSE(choose("Rain"));
    CHECK(box.getText() == rig.plugin.getProgramName(rig.plugin.getNumPrograms() - 1) + " *"); // the one before it
}

TEST_CASE("The menu of a control resets it, lets a value be typed, and has what the host offers")
{
    struct Offer final : juce::HostProvidedContextMenu
    {
        explicit Offer(int& counted) : chosen(counted) {}
        juce::PopupMenu getEquivalentPopupMenu() const override
        {
            juce::PopupMenu menu;
            menu.addItem("Show automation", [this] { ++chosen; });
            return menu;
        }
        void showNativeMenu(juce::Point<int>) const override {}
        int& chosen;
    };
    struct Host final : juce::AudioProcessorEditorHostContext
    {
        std::unique_ptr<juce::HostProvidedContextMenu>
        getContextMenuForParameter(const juce::AudioProcessorParameter* wanted) const override
        {
            asked = wanted;
            return std::make_unique<Offer>(chosen);
        }
        mutable const juce::AudioProcessorParameter* asked = nullptr;
        mutable int chosen = 0;
    };
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    auto& attack = rig.plugin.parameter(ParameterId::attack);
    attack.setPlainNotifyingHost(50.0);
    const auto reset = "Reset to " + attack.getText(attack.getDefaultValue(), 0);
    int typed = 0;
    const Host host;
    {
        const auto menu = editor::parameterMenu(
            attack, [&] { ++typed; }, &host);
        CHECK(host.asked == &attack);
        CHECK(textsOf(menu).contains(reset));
        CHECK(chooseFrom(menu, reset));
        CHECK(chooseFrom(menu, juce::String::fromUTF8("Type a value…")));
        CHECK(chooseFrom(menu, "Show automation"));
    }
    CHECK(attack.value() == Approx(1.0));
    CHECK(typed == 1);
    CHECK(host.chosen == 1);
    CHECK(rig.plugin.canUndo());                                                // a reset is a step
    CHECK_FALSE(chooseFrom(editor::parameterMenu(attack, {}, nullptr), reset)); // it is there
    CHECK(textsOf(editor::parameterMenu(attack, {}, nullptr)).size() == 1);
}

TEST_CASE("The right button moves no control, and Shift+F10 shows the menu of each", "[.display]") // menus need one
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    const std::unique_ptr<juce::AudioProcessorEditor> made(rig.plugin.createEditor());
    juce::Component& window = *made;
    const auto before = rig.plugin.values();
    int controls = 0;
    visitAll(window,
             [&](juce::Component& child)
             {
                 const bool knob = dynamic_cast<editor::Slider*>(&child) != nullptr;
                 if (!knob && dynamic_cast<editor::ParameterToggle*>(&child) == nullptr)
                     return;
                 ++controls;
                 const auto right = juce::ModifierKeys(juce::ModifierKeys::rightButtonModifier);
                 const auto event = [&](float y)
                 {
                     return juce::MouseEvent(juce::Desktop::getInstance().getMainMouseSource(), {10.0f, y}, right, 0.0f,
                                             0.0f, 0.0f, 0.0f, 0.0f, &child, &child, {}, {10.0f, 10.0f}, {}, 1, true);
                 };
                 child.mouseDown(event(10.0f));
                 child.mouseDrag(event(90.0f));
                 child.mouseUp(event(90.0f));
                 juce::PopupMenu::dismissAllActiveMenus();
             });
    CHECK(controls > 15);
    CHECK(rig.plugin.values() == before);
    CHECK_FALSE(rig.plugin.canUndo());
    CHECK(editor::isContextMenuKey(juce::KeyPress(juce::KeyPress::F10Key, juce::ModifierKeys::shiftModifier, 0)));
    int owners = 0;
    visitAll(window,
             [&](juce::Component& child)
             {
                 if (dynamic_cast<editor::Refreshed*>(&child) == nullptr)
                     return;
                 ++owners;
                 CHECK(child.keyPressed(juce::KeyPress(juce::KeyPress::F10Key, juce::ModifierKeys::shiftModifier, 0)));
                 juce::PopupMenu::dismissAllActiveMenus();
             });
    CHECK(owners > 20);
    pumpFor(0.05);
}

TEST_CASE("The scale of the window is one for all sessions, and changes nothing of its layout")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    juce::Component host;
    {
        plugin::PluginWindow window(rig.plugin);
        host.addAndMakeVisible(window);
        const auto before = window.getLocalBounds();
        for (const int percent : plugin::WindowSettings::scales)
        {
            CHECK(chooseFrom(window.menu(), juce::String(percent) + " %"));
            CHECK(window.getLocalBounds() == before);
            CHECK(host.getLocalArea(&window, window.getLocalBounds()).getWidth() == before.getWidth() * percent / 100);
        }
        window.setScaleFactor(2.0f); // by the host, besides
        CHECK(host.getLocalArea(&window, window.getLocalBounds()).getWidth() == 4 * before.getWidth());
        window.chooseScale(150);
        window.chooseScale(33); // there is none
        host.removeChildComponent(&window);
    }
    WindowRig other;
    other.plugin.setUserFolder(rig.plugin.userFolder());
    {
        plugin::PluginWindow window(other.plugin);
        CHECK(window.scaleFactor() == Approx(1.0f));
        window.chooseScale(150);
    }
    plugin::PluginWindow again(rig.plugin);
    CHECK(again.scaleFactor() == Approx(1.5f));
    CHECK(rig.plugin.windowSize() == juce::Point<int>(again.getWidth(), again.getHeight())); // as before scaling
}

TEST_CASE("The window tells of its load and has help")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    for (int i = 0; i < 20; ++i)
        (void)rig.run(liveSounds(2, 9600, 3));
    CHECK(rig.plugin.load() > 0.0);
    CHECK(rig.plugin.load() < 1.0);
    plugin::PluginWindow window(rig.plugin);
    CHECK(controlOf<juce::Label>(window, "Status").getText().contains("load 0."));
    CHECK(chooseFrom(window.menu(), "Help"));
    REQUIRE(dynamic_cast<editor::HelpSheet*>(window.sheet()) != nullptr);
    bool found = false;
    visitAll(*window.sheet(),
             [&](juce::Component& child)
             {
                 if (auto* text = dynamic_cast<juce::TextEditor*>(&child))
                     found = found || text->getText().startsWith("Plugin");
             });
    CHECK(found);
    CHECK_FALSE(window.keyPressed(undoKey())); // keys stay with the help
}

TEST_CASE("The menu offers the controllers that are connected now, and the window tells what becomes of the chosen one")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    FakePad pad, other("Pro Controller", "/dev/fake1");
    pad.isPlugged = other.isPlugged = false;
    WindowRig rig;
    rig.plugin.pad().setAccess(accessTo({&pad, &other}));
    plugin::PluginWindow window(rig.plugin);
    auto& status = controlOf<juce::Label>(window, "Status");
    CHECK(textsOf(window.menu()).contains("No supported controller connected"));
    CHECK_FALSE(textsOf(window.menu()).contains("Wireless Controller"));
    pad.isPlugged = other.isPlugged = true;
    CHECK(textsOf(window.menu()).contains("Pro Controller"));
    CHECK_FALSE(textsOf(window.menu()).contains("No supported controller connected"));
    CHECK_FALSE(rig.plugin.canUndo());
    const juce::String usual = status.getText();
    CHECK(usual.contains("latency"));

    CHECK(chooseFrom(window.menu(), "Wireless Controller"));
    REQUIRE(becomes([&] { return rig.plugin.pad().status().plays; }));
    window.refresh();
    CHECK(status.getText() == usual);
    CHECK(textsOf(window.menu()).contains("Wireless Controller plays"));
    CHECK_FALSE(rig.plugin.canUndo()); // it belongs to the machine

    pad.isPlugged = false;
    REQUIRE(becomes([&] { return !rig.plugin.pad().status().plays; }));
    window.refresh();
    CHECK(status.getText() == "Wireless Controller is not connected; it plays as soon as it is");
    CHECK(textsOf(window.menu()).contains(status.getText()));
    CHECK(textsOf(window.menu()).contains("Wireless Controller"));
    pad.isRefused = true;
    pad.isPlugged = true;
    CHECK(becomes(
        [&]
        {
            window.refresh();
            return status.getText() == "Wireless Controller is in use by another program; end that first";
        }));
    pad.isRefused = false;
    pad.lesser = "refuses samples";
    CHECK(becomes(
        [&]
        {
            window.refresh();
            return status.getText() == "Wireless Controller plays by rumble: it refuses samples";
        }));
    CHECK(chooseFrom(window.menu(), "None"));
    window.refresh();
    CHECK(status.getText() == usual);
}

TEST_CASE("Pictures of the window at all scales, light and dark, for a person to look at", "[.pictures]")
{
    const char* folder = std::getenv("PACINI_PICTURES");
    if (folder == nullptr)
        return;
    const juce::ScopedJuceInitialiser_GUI gui;
    if (const char* language = std::getenv("PACINI_LANGUAGE"))
        editor::useLanguage(language);
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    (void)rig.run(liveSounds(2, 48000, 3));
    rig.set(ParameterId::attack, 61.0);
    const auto write = [&](const juce::String& called)
    {
        window.refresh();
        juce::File file = juce::File(folder).getChildFile(called + ".png");
        file.deleteFile();
        juce::FileOutputStream stream(file);
        const float scale = window.scaleFactor();
        juce::PNGImageFormat().writeImageToStream(window.createComponentSnapshot(window.getLocalBounds(), true, scale),
                                                  stream);
    };
    for (const bool dark : {false, true})
        for (const int percent : plugin::WindowSettings::scales)
        {
            window.setDark(dark);
            window.chooseScale(percent);
            write((dark ? "dark-" : "light-") + juce::String(percent));
        }
    window.chooseScale(100);
    window.setSize(plugin::PluginWindow::leastWidth, plugin::PluginWindow::leastHeight);
    rig.plugin.chooseProgram(2);
    rig.set(ParameterId::attack, 61.0);
    write("least");
    window.show(plugin::PluginWindow::Page::actuators);
    write("actuators");
    window.show(plugin::PluginWindow::Page::live);
    controlOf<plugin::PresetBox>(window, editor::tr("Preset")).save();
    write("save");
    name(window, "Rain");
    write("saved");
    window.keyPressed(juce::KeyPress(juce::KeyPress::F1Key));
    write("help");
}
