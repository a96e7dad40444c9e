// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/view/EventKind.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/lanes/CurveLane.h"
#include "editor/clip/session/StepText.h"
#include "editor/clip/sheets/HistorySheet.h"
#include "editor/clip/sheets/PreferencesSheet.h"

#include <optional>

namespace pacini::editor
{

namespace
{
std::optional<Lane> focusedLane()
{
    const auto* row = dynamic_cast<const CurveLane*>(juce::Component::getCurrentlyFocusedComponent());
    return row != nullptr ? std::optional(row->lane()) : std::nullopt;
}

/// The points of the lane with the focus, else all transients.
Selection everything(const Clip& clip)
{
    Selection all;
    if (const auto lane = focusedLane())
        return withPoints({}, *lane, allIndices(curveOf(clip, *lane)->size()));
    all.transients = allIndices(clip.transients.size());
    return all;
}
} // namespace

Menu editMenu(EditorView& view)
{
    Session& session = view.session();
    const auto anyClip = hasClip(session);
    const auto anySelected = [&session]
    {
        return !isEmpty(session.clipSelection.selected());
    };
    using Key = juce::KeyPress;
    Menu menu("Edit");
    menu.add(
            undo, "Undo", "Undoes the last step", [&session] { session.model.undo(); },
            [&session] { return session.model.document().steps().canUndo(); }, {ctrl('z')})
        .fullName = [&session]
    {
        return commandWithStep("Undo", "Undo {0}", session.model.document().steps().undoName());
    };
    menu.add(
            redo, "Redo", "Redoes the last undone step", [&session] { session.model.redo(); },
            [&session] { return session.model.document().steps().canRedo(); }, {ctrlShift('z'), ctrl('y')})
        .fullName = [&session]
    {
        return commandWithStep("Redo", "Redo {0}", session.model.document().steps().redoName());
    };
    menu.add(
        showHistory, "History...", "Lists all steps and jumps to any of them",
        [&view] { view.showSheet(std::make_unique<HistorySheet>(view.session().model)); },
        [&session] { return session.model.document().steps().size() > 1; },
        {Key('z', juce::ModifierKeys::commandModifier | juce::ModifierKeys::altModifier, 0)});
    menu.addLine();
    menu.add(cut, "Cut", "Cuts the selection or the time range", [&session] { session.clipSelection.cut(); }, anyClip,
             {ctrl('x')});
    menu.add(copy, "Copy", "Copies the selection, or the time range in all lanes",
             [&session] { session.clipSelection.copy(); }, anyClip, {ctrl('c')});
    menu.add(
        paste, "Paste at playhead", "Pastes into the same lanes; a single lane goes into the focused one",
        [&session] { session.clipSelection.paste(session.transport.playhead(), focusedLane()); },
        [&session] { return session.model.clip() && session.clipSelection.canPaste(); }, {ctrl('v')});
    menu.add(deleteSelection, "Delete points", "Deletes the selected points and events",
             [&session] { session.clipSelection.deleteSelection(); }, anySelected,
             {Key(Key::deleteKey), Key(Key::backspaceKey)});
    menu.addLine();
    menu.add(selectAll, "Select all", "Selects all points of the focused lane, or all events",
             [&session] { session.clipSelection.select(everything(*session.model.clip())); }, anyClip, {ctrl('a')});
    menu.add(
        selectKind, "Select events of this kind", "Selects all events of the same kind: thuds, knocks or clicks",
        [&session]
        { session.clipSelection.select(selectKinds(*session.model.clip(), session.clipSelection.selected())); },
        [&session] { return session.model.clip() && !session.clipSelection.selected().transients.empty(); },
        {Key('a', juce::ModifierKeys::commandModifier | juce::ModifierKeys::altModifier, 0)});
    menu.add(selectNone, "Deselect all", "Clears the selection", [&session] { session.clipSelection.select({}); },
             anySelected, {ctrlShift('a')});
    menu.addLine();
    menu.add(preferences, "Preferences...", "Appearance and behaviour of the editor",
             [&view] { view.showSheet(std::make_unique<PreferencesSheet>(view)); }, {}, {ctrl(',')});
    return menu;
}

} // namespace pacini::editor
