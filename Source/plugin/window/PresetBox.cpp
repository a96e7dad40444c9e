// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/window/PresetBox.h"

#include "editor/Text.h"
#include "editor/Translation.h"
#include "editor/clip/sheets/NameSheet.h"

#include <pacini/realtime/TranslatorPresets.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace pacini::plugin
{

namespace
{
using editor::toText;
using editor::tr;
} // namespace

PresetBox::PresetBox(Plugin& wanted, std::function<void(std::unique_ptr<editor::Sheet>)> onAsk)
    : processor(wanted), ask(std::move(onAsk)), files(editor::pathOf(wanted.userFolder().getChildFile("Presets")))
{
    setTitle("Preset");
    setDescription("Preset to start from");
    setTooltip("Preset to start from");
    setWantsKeyboardFocus(true);
    onChange = [this]
    {
        if (const int id = getSelectedId(); id > 0 && id != shown.id)
            choose(id);
    };
    reload();
}

void PresetBox::reload()
{
    listing = presetsIn(files);
    clear(juce::dontSendNotification);
    for (int i = 0; i < processor.getNumPrograms(); ++i)
        addItem(nameOf(i + 1), i + 1);
    if (!listing.presets.empty() || !listing.broken.empty())
        addSectionHeading(tr("Own presets"));
    for (int i = 0; i < static_cast<int>(listing.presets.size()); ++i)
        addItem(nameOf(userIds + i), userIds + i);
    for (int i = 0; i < static_cast<int>(listing.broken.size()); ++i)
    {
        const Error& error = listing.broken[static_cast<std::size_t>(i)];
        addItem(tr("{0} cannot be used: {1}", {toText(error.where), editor::translateMessage(toText(error.message))}),
                brokenIds + i);
        setItemEnabled(brokenIds + i, false);
    }
    addSeparator();
    addItem(tr(toText("Save preset…")), saveId);
    addItem(tr(toText("Delete preset…")), deleteId);
    shown = {};
    refresh();
}

/// The preset in use can be chosen, too: that brings its values back.
void PresetBox::showPopup()
{
    reload(); // other instances may have saved some
    juce::PopupMenu menu = *getRootMenu();
    menu.setLookAndFeel(&getLookAndFeel());
    for (juce::PopupMenu::MenuItemIterator each(menu, true); each.next();)
        each.getItem().isTicked = each.getItem().itemID == shown.id;
    menu.showMenuAsync(juce::PopupMenu::Options()
                           .withTargetComponent(this)
                           .withMinimumWidth(getWidth())
                           .withItemThatMustBeVisible(shown.id)
                           .withInitiallySelectedItem(shown.id),
                       [box = juce::Component::SafePointer<PresetBox>(this)](int id)
                       {
                           if (!box)
                               return;
                           box->hidePopup();
                           if (id > 0)
                               box->choose(id);
                       });
}

bool PresetBox::keyPressed(const juce::KeyPress& key)
{
    const bool back = key == juce::KeyPress::upKey || key == juce::KeyPress::leftKey;
    const bool on = key == juce::KeyPress::downKey || key == juce::KeyPress::rightKey;
    if (!back && !on)
        return juce::ComboBox::keyPressed(key);
    const int programs = processor.getNumPrograms();
    const int count = programs + static_cast<int>(listing.presets.size());
    const int at = shown.id >= userIds ? programs + shown.id - userIds : shown.id - 1;
    const int next = juce::jlimit(0, count - 1, back ? at - 1 : at + 1);
    if (next != at)
        choose(next < programs ? next + 1 : userIds + next - programs);
    return true;
}

PresetBox::Shown PresetBox::now() const
{
    const PresetChoice choice = processor.presetChoice();
    const TranslatorParams params = processor.values().translator();
    const auto found = std::find_if(listing.presets.begin(), listing.presets.end(),
                                    [&](const UserPreset& each) { return each.name == choice.user; });
    if (!choice.user.empty() && found != listing.presets.end())
    {
        ParameterValues values; // without the bypass, which a preset leaves as it is
        values.setTranslator(found->params);
        return {userIds + static_cast<int>(found - listing.presets.begin()), params != values.translator()};
    }
    const auto program = static_cast<std::size_t>(choice.program);
    return {choice.program + 1, params != translatorPresets()[program].params};
}

juce::String PresetBox::nameOf(int id) const
{
    if (id >= userIds)
        return toText(listing.presets[static_cast<std::size_t>(id - userIds)].name);
    return tr(processor.getProgramName(id - 1));
}

void PresetBox::refresh()
{
    const Shown next = now();
    if (next == shown && getSelectedId() == shown.id)
        return;
    if (shown.id > 0)
        changeItemText(shown.id, nameOf(shown.id));
    shown = next;
    changeItemText(shown.id, nameOf(shown.id) + (shown.altered ? " *" : ""));
    setItemEnabled(deleteId, shown.id >= userIds);
    setSelectedId(0, juce::dontSendNotification); // so that the text is taken anew
    setSelectedId(shown.id, juce::dontSendNotification);
}

void PresetBox::choose(int id)
{
    if (id == saveId)
        save();
    else if (id == deleteId)
        remove();
    else if (id >= userIds && id < brokenIds)
        processor.choosePreset(listing.presets[static_cast<std::size_t>(id - userIds)]);
    else if (id < userIds)
        processor.chooseProgram(id - 1);
    refresh();
}

void PresetBox::save()
{
    ask(std::make_unique<editor::NameSheet>(
        tr("Save preset"), tr("Name"), shown.id >= userIds ? nameOf(shown.id) : juce::String(),
        [this](const juce::String& name)
        {
            if (!files.exists(name.toStdString()))
                return write(name, false);
            ask(std::make_unique<editor::MessageSheet>(tr("Replace {0}?", {name}),
                                                       tr("There is a preset of this name."),
                                                       std::vector<editor::Sheet::Answer>{{tr("Cancel"), {}},
                                                                                          {tr("Replace"), [this, name]
                                                                                           {
                                                                                               write(name, true);
                                                                                           }}}));
        },
        tr("Save")));
}

void PresetBox::write(const juce::String& name, bool replace)
{
    if (const auto saved = files.save(name.toStdString(), liveSettings(processor.values().translator()), replace);
        !saved)
        return tell(tr("Preset not saved"), saved.error());
    processor.noteSavedPreset(name.toStdString());
    reload();
}

void PresetBox::remove()
{
    if (shown.id < userIds)
        return;
    const juce::String name = nameOf(shown.id);
    ask(std::make_unique<editor::MessageSheet>(
        tr("Delete {0}?", {name}), tr("The preset's file is deleted. What is heard and felt stays as it is."),
        std::vector<editor::Sheet::Answer>{{tr("Cancel"), {}},
                                           {tr("Delete"), [this, name]
                                            {
                                                if (const auto gone = files.remove(name.toStdString()); !gone)
                                                    tell(tr("Preset not deleted"), gone.error());
                                                reload();
                                            }}}));
}

void PresetBox::tell(const juce::String& title, const Error& error)
{
    ask(std::make_unique<editor::MessageSheet>(title, editor::translateMessage(toText(error.text())),
                                               std::vector<editor::Sheet::Answer>{{tr("Close"), {}}}));
}

} // namespace pacini::plugin
