// SPDX-License-Identifier: GPL-3.0-or-later

// What is done to clips in their list: renamed, moved, grouped, removed.

#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/clip/panels/ClipList.h"

#include <algorithm>

namespace pacini::editor
{

bool ClipList::keyPressed(const juce::KeyPress& key, juce::Component*)
{
    const int row = list.getSelectedRow();
    if (at(row) == nullptr)
        return false;
    const bool alt = key.getModifiers().isAltDown();
    if (key.isKeyCode(juce::KeyPress::F2Key))
        beginRename(row);
    else if (alt && key.isKeyCode(juce::KeyPress::upKey))
        move(row, static_cast<std::size_t>(std::max(0, row - 1)));
    else if (alt && key.isKeyCode(juce::KeyPress::downKey))
        move(row, static_cast<std::size_t>(row) + 2);
    else if (key == juce::KeyPress(juce::KeyPress::F10Key, juce::ModifierKeys::shiftModifier, 0))
        showMenu(row, list.localAreaToGlobal(list.getRowPosition(row, true)));
    else
        return false;
    return true;
}

void ClipList::rename(int row, const juce::String& name)
{
    const ClipRow* shown = at(row);
    const std::string wanted = name.trim().toStdString();
    if (shown == nullptr || wanted.empty() || nameOf(*shown) == toText(wanted))
        return;
    const ClipRow was = *shown;
    model.change(
        [&was, &wanted](Document& document) -> Result<void>
        {
            if (was.clip != 0)
                return document.edit(was.clip, "Rename clip", RenameEdit{wanted});
            document.renameGroup(was.group, wanted, "Rename group");
            return {};
        });
    for (std::size_t i = 0; was.clip == 0 && i < rowsNow.size(); ++i)
        if (rowsNow[i] == ClipRow{0, wanted})
            list.selectRow(static_cast<int>(i));
}

void ClipList::remove(int row)
{
    const ClipRow* shown = at(row);
    if (shown == nullptr)
        return;
    const ClipRow was = *shown;
    if (was.clip != 0 && was.clip == model.activeId())
        return model.removeClip();
    model.change(
        [&was](Document& document) -> Result<void>
        {
            if (was.clip != 0)
                return document.removeClip(was.clip, "Remove clip");
            document.renameGroup(was.group, {}, "Remove group");
            return {};
        });
}

void ClipList::duplicate(int row)
{
    const ClipRow* shown = at(row);
    if (shown == nullptr || shown->clip == 0)
        return;
    if (shown->clip != model.activeId())
        model.show(shown->clip);
    model.duplicate();
}

void ClipList::move(int row, std::size_t above)
{
    const ClipRow* shown = at(row);
    if (shown == nullptr || shown->clip == 0)
        return;
    const int id = shown->clip;
    const Project& project = model.document().project();
    const ClipPlace place = placeAbove(project, rowsNow, above, id);
    const auto item = project.find(id);
    if (item && item->group == place.group && place.index < project.clips.size() &&
        project.clips[place.index]->id == id)
        return;
    model.change([&](Document& document) { return document.placeClip(id, place.index, place.group, "Move clip"); });
}

void ClipList::setGroup(int row, const std::string& group)
{
    const ClipRow* shown = at(row);
    if (shown == nullptr || shown->clip == 0 || shown->group == group)
        return;
    const auto& clips = model.document().project().clips;
    const int id = shown->clip;
    // Its place among all clips stays.
    const auto place = std::find_if(clips.begin(), clips.end(), [id](const auto& item) { return item->id == id; });
    model.change(
        [&](Document& document)
        { return document.placeClip(id, static_cast<std::size_t>(place - clips.begin()), group, "Move to group"); });
}

void ClipList::addGroup(int row)
{
    const std::string name = freeGroupName(model.document().project());
    if (const ClipRow* shown = at(row); shown != nullptr && shown->clip != 0)
        setGroup(row, name);
    else
        model.change(
            [&](Document& document) -> Result<void>
            {
                auto groups = groupsOf(document.project());
                groups.push_back(name);
                document.setGroups(std::move(groups), "New group");
                return {};
            });
    for (std::size_t i = 0; i < rowsNow.size(); ++i)
        if (rowsNow[i].clip == 0 && rowsNow[i].group == name)
            beginRename(static_cast<int>(i));
}

void ClipList::beginRename(int row)
{
    const ClipRow* shown = at(row);
    if (shown == nullptr)
        return;
    list.scrollToEnsureRowIsOnscreen(row);
    nameField = std::make_unique<juce::TextEditor>();
    nameField->setTitle(shown->clip != 0 ? "Name of the clip" : "Name of the group");
    nameField->setFont(usualFont());
    nameField->setText(nameOf(*shown), false);
    nameField->setSelectAllWhenFocused(true);
    nameField->setBounds(list.getRowPosition(row, true).reduced(1));
    const auto end = [this](int renamed, bool keep)
    {
        if (!nameField)
            return;
        // Not from within one of its own functions.
        std::shared_ptr<juce::TextEditor> old = std::move(nameField);
        old->onFocusLost = nullptr;
        const juce::String text = old->getText();
        removeChildComponent(old.get());
        juce::MessageManager::callAsync([old] {});
        if (keep)
            rename(renamed, text);
        if (list.isShowing())
            list.grabKeyboardFocus();
    };
    nameField->onReturnKey = [end, row]
    {
        end(row, true);
    };
    nameField->onEscapeKey = [end, row]
    {
        end(row, false);
    };
    nameField->onFocusLost = [end, row]
    {
        end(row, true);
    };
    addAndMakeVisible(*nameField);
    if (isShowing())
        nameField->grabKeyboardFocus();
}

} // namespace pacini::editor
