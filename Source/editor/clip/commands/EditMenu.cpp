// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/Text.h"
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/lanes/CurveLane.h"

#include <optional>

namespace pacini::editor
{

namespace
{
juce::String nameWithStep(const char* name, const std::string& step)
{
    return step.empty() ? tr(name) : tr(name) + " " + tr(toText(step)).toLowerCase();
}

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
    const auto anyClip = [&session]
    {
        return session.model.clip() != nullptr;
    };
    const auto anySelected = [&session]
    {
        return !isEmpty(session.clipSelection.selected());
    };
    using Key = juce::KeyPress;
    return {"Edit",
            {
                {.id = undo,
                 .name = "Undo",
                 .help = "Undoes the last step",
                 .run = [&session] { session.model.undo(); },
                 .can = [&session] { return session.model.document().canUndo(); },
                 .keys = {ctrl('z')},
                 .fullName =
                     [&session]
                 {
                     return nameWithStep("Undo", session.model.document().undoName());
                 }},
                {.id = redo,
                 .name = "Redo",
                 .help = "Redoes the last step that was undone",
                 .run = [&session] { session.model.redo(); },
                 .can = [&session] { return session.model.document().canRedo(); },
                 .keys = {ctrlShift('z'), ctrl('y')},
                 .fullName =
                     [&session]
                 {
                     return nameWithStep("Redo", session.model.document().redoName());
                 }},
                {.id = cut,
                 .name = "Cut",
                 .help = "Copies and removes what is selected, or the time range",
                 .run = [&session] { session.clipSelection.cut(); },
                 .can = anyClip,
                 .keys = {ctrl('x')},
                 .lineBefore = true},
                {.id = copy,
                 .name = "Copy",
                 .help = "Copies what is selected, or the time range of all lanes",
                 .run = [&session] { session.clipSelection.copy(); },
                 .can = anyClip,
                 .keys = {ctrl('c')}},
                {.id = paste,
                 .name = "Paste at playhead",
                 .help = "Pastes into the lanes it was copied from; a single lane into the one with the focus",
                 .run = [&session] { session.clipSelection.paste(session.transport.playhead(), focusedLane()); },
                 .can = [&session] { return session.model.clip() && session.clipSelection.canPaste(); },
                 .keys = {ctrl('v')}},
                {.id = deleteSelection,
                 .name = "Delete points",
                 .help = "Removes the selected points and transients",
                 .run = [&session] { session.clipSelection.deleteSelection(); },
                 .can = anySelected,
                 .keys = {Key(Key::deleteKey), Key(Key::backspaceKey)}},
                {.id = selectAll,
                 .name = "Select all",
                 .help = "Selects all points of the lane with the focus, else all transients",
                 .run = [&session] { session.clipSelection.select(everything(*session.model.clip())); },
                 .can = anyClip,
                 .keys = {ctrl('a')},
                 .lineBefore = true},
                {.id = selectNone,
                 .name = "Select nothing",
                 .help = "Selects nothing",
                 .run = [&session] { session.clipSelection.select({}); },
                 .can = anySelected,
                 .keys = {ctrlShift('a')}},
            }};
}

} // namespace pacini::editor
