// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/panels/UnfittingList.h"

#include "document/EditText.h"
#include "document/ProjectEdits.h"
#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{
constexpr int unfittingRowHeight = 12 * grid;
constexpr double least = 0.5; // s shown around an edit
} // namespace

class UnfittingList::Row final : public juce::Component
{
public:
    explicit Row(UnfittingList& all)
    {
        prepareButton(show, tr("Shows this edit in the clip"), [this, &all] { all.showEdit(index); });
        prepareButton(remove, tr("Deletes this edit (undo restores it)"), [this, &all] { all.removeEdit(index); });
        addAndMakeVisible(show);
        addAndMakeVisible(remove);
    }

    void set(int row, const juce::String& name, const juce::String& why)
    {
        index = row;
        title = name;
        reason = why;
        show.setTitle(tr("Show: {0}", {title}));
        remove.setTitle(tr("Remove: {0}", {title}));
        setTitle(title + ": " + reason);
        repaint();
    }

    void paint(juce::Graphics& g) override
    {
        const Palette& p = paletteFor(*this);
        auto area = getLocalBounds().reduced(2, 2);
        g.setColour(p.text);
        g.setFont(smallFont());
        g.drawFittedText(title, area.removeFromTop(2 * grid), juce::Justification::centredLeft, 1);
        g.setColour(p.dim);
        g.drawFittedText(reason, area.removeFromTop(5 * grid), juce::Justification::topLeft, 3);
        g.setColour(p.line);
        g.fillRect(getLocalBounds().removeFromBottom(1));
    }

    void resized() override
    {
        auto line = getLocalBounds().reduced(2, 4).removeFromBottom(3 * grid);
        show.setBounds(line.removeFromLeft(8 * grid));
        line.removeFromLeft(grid);
        remove.setBounds(line.removeFromLeft(9 * grid));
    }

private:
    int index = 0;
    juce::String title, reason;
    juce::TextButton show{tr("Show")}, remove{tr("Remove")};
};

UnfittingList::UnfittingList(EditorModel& project, ViewState& sight, Transport& playing)
    : model(project), viewState(sight), transport(playing)
{
    list.setRowHeight(unfittingRowHeight);
    list.setColour(juce::ListBox::backgroundColourId, juce::Colours::transparentBlack);
    list.setTitle("Unapplied edits");
    list.setTooltip("Edits that do not fit this analysis. They are kept and reapplied when they fit again");
    addAndMakeVisible(list);
    refresh();
}

UnfittingList::~UnfittingList()
{
    list.setModel(nullptr);
}

void UnfittingList::refresh()
{
    list.setVisible(getNumRows() > 0);
    list.updateContent();
    repaint();
}

juce::String UnfittingList::heading() const
{
    const auto item = model.item();
    const int count = item ? static_cast<int>(item->unfitting.size()) : 0;
    return count == 0 ? tr("Edits")
                      : counted(static_cast<std::size_t>(count), "{0} unapplied edit", "{0} unapplied edits");
}

int UnfittingList::getNumRows()
{
    const auto item = model.item();
    return item ? static_cast<int>(item->unfitting.size()) : 0;
}

std::shared_ptr<const Edit> UnfittingList::editOf(int row) const
{
    const auto item = model.item();
    if (!item || row < 0 || row >= static_cast<int>(item->unfitting.size()))
        return nullptr;
    const std::size_t index = item->unfitting[static_cast<std::size_t>(row)].edit;
    const auto all = item->edits.whole();
    return index < all.size() ? all[index] : nullptr;
}

juce::String UnfittingList::reasonOf(int row) const
{
    const auto item = model.item();
    return item && row >= 0 && row < static_cast<int>(item->unfitting.size())
               ? translateMessage(toText(item->unfitting[static_cast<std::size_t>(row)].reason))
               : juce::String();
}

juce::Component* UnfittingList::refreshComponentForRow(int row, bool, juce::Component* existing)
{
    std::unique_ptr<juce::Component> owned(existing);
    const auto edit = editOf(row);
    if (!edit)
        return nullptr;
    if (!owned)
        owned = std::make_unique<Row>(*this);
    juce::String title = translateMessage(toText(editTitle(*edit)));
    if (const auto time = editTime(*edit))
        title << ", " << numberText(time->from, 2) << " s";
    static_cast<Row&>(*owned).set(row, title, reasonOf(row));
    return owned.release();
}

juce::String UnfittingList::getNameForRow(int row)
{
    const auto edit = editOf(row);
    return edit ? translateMessage(toText(editTitle(*edit))) + ": " + reasonOf(row) : juce::String();
}

void UnfittingList::showEdit(int row)
{
    const auto edit = editOf(row);
    if (!edit)
        return;
    const auto time = editTime(*edit);
    if (!time)
        return viewState.fit();
    const double middle = std::clamp(0.5 * (time->from + time->to), 0.0, model.duration());
    const double half = std::max(least, time->to - time->from);
    transport.setPlayhead(std::min(time->from, model.duration()));
    viewState.showRange({std::max(0.0, middle - half), middle + half});
}

void UnfittingList::removeEdit(int row)
{
    const auto item = model.item();
    if (!editOf(row))
        return;
    const std::size_t index = item->unfitting[static_cast<std::size_t>(row)].edit;
    // Not from within the button of a row that goes away.
    juce::MessageManager::callAsync(
        [self = juce::Component::SafePointer<UnfittingList>(this), id = item->id, index]
        {
            if (self)
                self->model.commit("Remove edit", withoutEdits(self->model.document().project(), id, {index}));
        });
}

void UnfittingList::paint(juce::Graphics& g)
{
    if (getNumRows() > 0)
        return;
    g.setColour(paletteFor(*this).dim);
    g.setFont(smallFont());
    const auto item = model.item();
    const std::size_t count = item ? item->edits.size() : 0;
    constexpr auto hint = "Edits survive re-analysis. Those that no longer fit are listed here.";
    g.drawFittedText(tr(count == 0 ? hint : "All edits fit this analysis."), getLocalBounds(),
                     juce::Justification::topLeft, 4, 1.0f);
}

void UnfittingList::resized()
{
    list.setBounds(getLocalBounds());
}

} // namespace pacini::editor
