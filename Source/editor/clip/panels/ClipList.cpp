// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/panels/ClipList.h"

#include "document/ProjectEdits.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/scene/SceneSelection.h"
#include "editor/clip/session/ClipSteps.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{
constexpr int clipRowHeight = 26;
constexpr int timeWidth = 6 * grid;
constexpr int searchHeight = 28;
constexpr std::size_t fewClips = 8; // are found without a search

juce::String lengthText(double seconds)
{
    const int whole = juce::roundToInt(seconds);
    return seconds < 60.0 ? numberText(seconds, 2) + " s"
                          : juce::String(whole / 60) + ":" + juce::String(whole % 60).paddedLeft('0', 2);
}
} // namespace

ClipList::ClipList(EditorModel& project) : model(project)
{
    list.setRowHeight(clipRowHeight);
    list.setTitle("Clips of the project");
    list.setTooltip("Choose a clip to edit it. Return renames, Delete removes, Alt+arrow keys move");
    list.setOutlineThickness(0);
    list.setMultipleSelectionEnabled(true);
    searchField.setTitle("Search clips");
    searchField.showWhenEmpty(tr("Search clips"));
    searchField.setJustification(juce::Justification::centredLeft);
    searchField.onTextChange = [this]
    {
        search(searchField.getText());
    };
    searchField.onEscapeKey = [this]
    {
        searchField.clear();
    };
    addChildComponent(searchField);
    list.addKeyListener(this);
    list.addMouseListener(this, true); // a ListBox drags in windows of their own
    addAndMakeVisible(list);
    subscriptions.on({&model.projectChanged}, [this] { refresh(); });
    refresh();
}

ClipList::~ClipList()
{
    list.removeKeyListener(this);
    list.removeMouseListener(this);
    list.setModel(nullptr);
}

void ClipList::refresh()
{
    // A heading stays chosen while its clips change.
    ClipRow chosen{model.activeId(), {}};
    if (const ClipRow* now = at(list.getSelectedRow()); now != nullptr && now->clip == 0)
        chosen = *now;
    const Project& project = model.document().project();
    if (const bool many = project.clips.size() > fewClips; many != searchField.isVisible())
    {
        searchField.setVisible(many);
        resized();
    }
    auto wanted = clipRows(project);
    if (!wordsNow.isEmpty())
    {
        const auto fits = [&](const ClipRow& row)
        {
            const auto item = row.clip != 0 ? project.find(row.clip) : nullptr;
            juce::String all;
            if (item)
                all << nameOf(row) << " " << toText(row.group) << " " << toText(item->notes) << " " << tagText(*item);
            return std::all_of(wordsNow.begin(), wordsNow.end(),
                               [&](const juce::String& word) { return all.containsIgnoreCase(word); });
        };
        std::erase_if(wanted, [&](const ClipRow& row) { return !fits(row); });
    }
    if (wanted != rowsNow)
    {
        rowsNow = std::move(wanted);
        list.updateContent();
    }
    // Several stay selected while the shown one is among them.
    const auto several = model.selectedClips();
    if (several.size() > 1)
    {
        juce::SparseSet<int> all;
        for (std::size_t i = 0; i < rowsNow.size(); ++i)
            if (std::find(several.begin(), several.end(), rowsNow[i].clip) != several.end())
                all.addRange({static_cast<int>(i), static_cast<int>(i) + 1});
        list.setSelectedRows(all, juce::dontSendNotification);
        list.repaint();
        return;
    }
    const auto isChosen = [&](const ClipRow& row)
    {
        return row.clip == chosen.clip && (row.clip != 0 || row.group == chosen.group);
    };
    auto found = std::find_if(rowsNow.begin(), rowsNow.end(), isChosen);
    if (found == rowsNow.end())
    {
        chosen.clip = model.activeId();
        found = std::find_if(rowsNow.begin(), rowsNow.end(), isChosen);
    }
    juce::SparseSet<int> shown;
    if (found != rowsNow.end())
    {
        const int row = static_cast<int>(found - rowsNow.begin());
        shown.addRange({row, row + 1});
    }
    list.setSelectedRows(shown, juce::dontSendNotification);
    list.repaint();
}

const ClipRow* ClipList::at(int row) const
{
    return row >= 0 && row < static_cast<int>(rowsNow.size()) ? &rowsNow[static_cast<std::size_t>(row)] : nullptr;
}

juce::String ClipList::nameOf(const ClipRow& row) const
{
    if (row.clip == 0)
        return toText(row.group);
    const auto item = model.document().clip(row.clip);
    if (!item)
        return {};
    return item->clip->name.empty() ? tr("Clip {0}", {juce::String(item->id)}) : toText(item->clip->name);
}

void ClipList::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool selected)
{
    const ClipRow* shown = at(row);
    if (shown == nullptr)
        return;
    const Palette& p = paletteFor(*this);
    auto area = juce::Rectangle<int>(width, height);
    if (selected)
    {
        g.setColour(p.accent.withAlpha(list.hasKeyboardFocus(true) ? 0.35f : 0.2f));
        g.fillRoundedRectangle(area.toFloat().reduced(1.0f), 4.0f);
    }
    const juce::Colour quiet = quietTextColour(p, selected);
    if (shown->clip == 0)
    {
        g.setColour(quiet);
        g.setFont(smallFont().boldened());
        g.drawText(nameOf(*shown), area.reduced(grid, 0), juce::Justification::centredLeft, true);
        g.setColour(p.line);
        g.fillRect(area.removeFromBottom(1));
        return;
    }
    const auto item = model.document().clip(shown->clip);
    if (!item)
        return;
    area.reduce(grid, 0);
    if (!shown->group.empty())
        area.removeFromLeft(grid);
    g.setFont(smallFont());
    g.setColour(quiet);
    g.drawText(lengthText(item->clip->duration), area.removeFromRight(timeWidth), juce::Justification::centredRight,
               false);
    g.setColour(p.text);
    g.setFont(usualFont());
    g.drawText(nameOf(*shown), area.withTrimmedRight(grid / 2), juce::Justification::centredLeft, true);
}

juce::String ClipList::getNameForRow(int row)
{
    const ClipRow* shown = at(row);
    if (shown == nullptr)
        return {};
    if (shown->clip == 0)
        return tr("Group {0}", {nameOf(*shown)});
    const auto item = model.document().clip(shown->clip);
    const auto text = nameOf(*shown) + ", " + (item ? lengthText(item->clip->duration) : juce::String());
    return shown->group.empty() ? text : tr("{0}, in group {1}", {text, toText(shown->group)});
}

juce::String ClipList::getTooltipForRow(int row)
{
    const ClipRow* shown = at(row);
    if (shown == nullptr)
        return {};
    return tr(shown->clip == 0 ? "Group {0}: drop clips below to add them"
                               : "{0}: drag to move, double-click to rename, right-click for more",
              {nameOf(*shown)});
}

void ClipList::search(const juce::String& words)
{
    wordsNow = juce::StringArray::fromTokens(words, " ", {});
    wordsNow.removeEmptyStrings();
    refresh();
}

/// What a command of a row's menu is for: all that are selected where it is one of them.
std::vector<int> ClipList::clipsFor(int row) const
{
    const ClipRow* shown = at(row);
    if (shown == nullptr || shown->clip == 0)
        return {};
    std::vector<int> clips;
    for (std::size_t i = 0; list.isRowSelected(row) && i < rowsNow.size(); ++i)
        if (rowsNow[i].clip != 0 && list.isRowSelected(static_cast<int>(i)))
            clips.push_back(rowsNow[i].clip);
    return clips.size() > 1 ? clips : std::vector<int>{shown->clip};
}

void ClipList::selectedRowsChanged(int row)
{
    model.selectClips(clipsFor(row));
    if (const ClipRow* chosen = at(row); chosen != nullptr && chosen->clip != 0 && chosen->clip != model.activeId())
        model.show(chosen->clip);
}

void ClipList::listBoxItemClicked(int row, const juce::MouseEvent& event)
{
    if (event.mods.isPopupMenu())
        showMenu(row, {event.getScreenX(), event.getScreenY(), 1, 1});
}

void ClipList::showMenu(int row, juce::Rectangle<int> beside)
{
    menuOf(row).showMenuAsync(
        juce::PopupMenu::Options().withTargetScreenArea(beside).withParentComponent(getTopLevelComponent()));
}

juce::PopupMenu ClipList::groupMenuOf(int row)
{
    juce::PopupMenu menu;
    menu.setLookAndFeel(&getLookAndFeel());
    const ClipRow* shown = at(row);
    const bool clip = shown != nullptr && shown->clip != 0;
    const std::string now = clip ? shown->group : std::string();
    using Self = juce::Component::SafePointer<ClipList>;
    if (clip)
    {
        menu.addItem(tr("No group"), true, now.empty(),
                     [self = Self(this), row]
                     {
                         if (self)
                             self->setGroup(row, {});
                     });
        for (const std::string& group : groupsOf(model.document().project()))
            menu.addItem(toText(group), true, now == group,
                         [self = Self(this), row, group]
                         {
                             if (self)
                                 self->setGroup(row, group);
                         });
        menu.addSeparator();
    }
    menu.addItem(tr("New group"),
                 [self = Self(this), row]
                 {
                     if (self)
                         self->addGroup(row);
                 });
    return menu;
}

juce::PopupMenu ClipList::menuOf(int row)
{
    juce::PopupMenu menu;
    menu.setLookAndFeel(&getLookAndFeel());
    const ClipRow* shown = at(row);
    if (shown == nullptr)
        return groupMenuOf(row);
    using Self = juce::Component::SafePointer<ClipList>;
    const auto item = [&](const juce::String& text, auto function)
    {
        menu.addItem(tr(text),
                     [self = Self(this), row, function]
                     {
                         if (self)
                             function(*self, row);
                     });
    };
    item("Rename", [](ClipList& self, int at) { self.beginRename(at); });
    if (shown->clip == 0)
    {
        item("Ungroup", [](ClipList& self, int at) { self.remove(at); });
        return menu;
    }
    item("Duplicate", [](ClipList& self, int at) { self.duplicate(at); });
    item("Add to scene",
         [](ClipList& self, int at)
         {
             SceneSelection scene(self.model);
             for (const int id : self.clipsFor(at))
                 scene.add(id, sceneEnd(self.model.document().project()));
         });
    item("Remove", [](ClipList& self, int at) { self.remove(at); });
    menu.addSeparator();
    item("Move up", [](ClipList& self, int at) { self.move(at, static_cast<std::size_t>(std::max(0, at - 1))); });
    item("Move down", [](ClipList& self, int at) { self.move(at, static_cast<std::size_t>(at) + 2); });
    menu.addSubMenu(tr("Move to group"), groupMenuOf(row));
    return menu;
}

void ClipList::mouseDrag(const juce::MouseEvent& event)
{
    constexpr int threshold = 5; // pixels
    if (isDragAndDropActive() || event.mods.isPopupMenu() || event.getDistanceFromDragStart() < threshold ||
        dynamic_cast<juce::ScrollBar*>(event.eventComponent) != nullptr)
        return;
    const auto here = event.getEventRelativeTo(&list);
    const auto start = here.getMouseDownPosition();
    const int row = list.getRowContainingPosition(start.x, start.y);
    if (const ClipRow* dragged = at(row); dragged == nullptr || dragged->clip == 0)
        return;
    juce::SparseSet<int> rows;
    rows.addRange({row, row + 1});
    int x = 0, y = 0;
    const auto image = list.createSnapshotOfRows(rows, x, y);
    const juce::Point<int> offset(x - here.x, y - here.y);
    startDragging(row, &list, image, false, &offset, &event.source);
}

bool ClipList::isInterestedInDragSource(const SourceDetails& details)
{
    return details.description.isInt() && details.sourceComponent.get() == &list;
}

int ClipList::gapAt(const SourceDetails& details) const
{
    const auto place = list.getLocalPoint(this, details.localPosition);
    return std::max(0, list.getInsertionIndexForPosition(std::clamp(place.x, 1, list.getWidth() - 1), place.y));
}

void ClipList::itemDragMove(const SourceDetails& details)
{
    gap = gapAt(details);
    repaint();
}

void ClipList::itemDragExit(const SourceDetails&)
{
    gap.reset();
    repaint();
}

void ClipList::itemDropped(const SourceDetails& details)
{
    const int above = gapAt(details);
    gap.reset();
    repaint();
    move(static_cast<int>(details.description), static_cast<std::size_t>(above));
}

void ClipList::paintOverChildren(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    if (rowsNow.empty())
    {
        g.setColour(p.dim);
        g.setFont(smallFont());
        g.drawFittedText(tr("No clips yet"), getLocalBounds(), juce::Justification::centred, 1);
    }
    if (!gap)
        return;
    const int y = list.getY() + (*gap < getNumRows() ? list.getRowPosition(*gap, true).getY()
                                 : getNumRows() > 0  ? list.getRowPosition(getNumRows() - 1, true).getBottom()
                                                     : 0);
    g.setColour(p.accent);
    g.fillRect(0, std::clamp(y - 1, 0, getHeight() - 2), getWidth(), 2);
}

void ClipList::resized()
{
    auto area = getLocalBounds();
    if (searchField.isVisible())
    {
        searchField.setBounds(area.removeFromTop(searchHeight));
        area.removeFromTop(grid / 2);
    }
    list.setBounds(area);
}

// What is done to clips.

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
    const Project& project = model.document().project();
    if (was.clip != 0)
        model.commit("Rename clip", withEdit(project, was.clip, RenameEdit{wanted}));
    else
        model.commit("Rename group", withGroupRenamed(project, was.group, wanted));
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
    if (was.clip != 0)
        return removeClips(model, clipsFor(row));
    model.commit("Remove group", withGroupRenamed(model.document().project(), was.group, {}));
}

void ClipList::duplicate(int row)
{
    const ClipRow* shown = at(row);
    if (shown == nullptr || shown->clip == 0)
        return;
    if (shown->clip != model.activeId())
        model.show(shown->clip);
    duplicateShown(model);
}

void ClipList::move(int row, std::size_t above)
{
    const ClipRow* shown = at(row);
    if (shown == nullptr || shown->clip == 0 || !wordsNow.isEmpty()) // what is between the rows is not seen
        return;
    const int id = shown->clip;
    const Project& project = model.document().project();
    const ClipPlace place = placeAbove(project, rowsNow, above, id);
    const auto item = project.find(id);
    if (item && item->group == place.group && place.index < project.clips.size() &&
        project.clips[place.index]->id == id)
        return;
    model.commit("Move clip", withPlaced(project, id, place.index, place.group));
}

void ClipList::setGroup(int row, const std::string& group)
{
    const auto clips = clipsFor(row);
    if (clips.empty() || (clips.size() == 1 && at(row)->group == group))
        return;
    model.commit("Move to group", withGroup(model.document().project(), clips, group));
}

void ClipList::addGroup(int row)
{
    const std::string name = freeGroupName(model.document().project());
    if (const ClipRow* shown = at(row); shown != nullptr && shown->clip != 0)
        setGroup(row, name);
    else
    {
        const Project& project = model.document().project();
        auto groups = groupsOf(project);
        groups.push_back(name);
        model.commit("New group", withGroups(project, std::move(groups)));
    }
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
    nameField->setTitle(tr(shown->clip != 0 ? "Clip name" : "Group name"));
    nameField->setFont(usualFont());
    nameField->setText(nameOf(*shown), false);
    nameField->setSelectAllWhenFocused(true);
    nameField->setBounds(list.getRowPosition(row, true).translated(0, list.getY()).reduced(1));
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
