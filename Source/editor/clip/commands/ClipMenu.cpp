// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/commands/Operations.h"

namespace pacini::editor
{

namespace
{
void showNext(Session& session)
{
    const auto& items = session.model.document().project().clips;
    for (std::size_t i = 0; i < items.size(); ++i)
        if (items[i]->id == session.model.activeId())
            return session.model.show(items[(i + 1) % items.size()]->id);
}

/// Asks for the arguments of an operation of the whole clip.
void ask(EditorView& view, Operation operation)
{
    view.showSheet(std::make_unique<OperationSheet>(view, std::move(operation), nullptr));
}
} // namespace

Menu clipMenu(EditorView& view)
{
    Session& session = view.session();
    const auto anyClip = [&session]
    {
        return session.model.clip() != nullptr;
    };
    return {"Clip",
            {
                {.id = trim,
                 .name = "Trim to time range",
                 .help = "Keeps the time range only",
                 .run =
                     [&session]
                 {
                     const auto range = *session.clipSelection.timeRange();
                     session.clipSelection.setTimeRange(std::nullopt);
                     session.model.edit("Trim", TrimEdit{range});
                 },
                 .can = [&session] { return session.model.clip() && session.clipSelection.timeRange(); },
                 .keys = {ctrl('t')}},
                {.id = reverse,
                 .name = "Reverse",
                 .help = "Plays the clip from its end",
                 .run = [&session] { session.model.edit("Reverse", ReverseEdit{}); },
                 .can = anyClip},
                {.id = transposePitch,
                 .name = "Transpose...",
                 .help = "Shifts all frequencies by semitones",
                 .run = [&view] { ask(view, transposeOperation()); },
                 .can = anyClip,
                 .keys = {ctrlShift('t')}},
                {.id = stretch,
                 .name = "Stretch...",
                 .help = "Longer or shorter, at the same pitch",
                 .run = [&view] { ask(view, stretchOperation(view.session().model)); },
                 .can = anyClip},
                {.id = repeatClipTimes,
                 .name = "Repeat...",
                 .help = "Repeats the clip a number of times",
                 .run = [&view] { ask(view, repeatOperation()); },
                 .can = anyClip,
                 .keys = {ctrl('r')}},
                {.id = splitClipHere,
                 .name = "Split at playhead",
                 .help = "The part after the playhead becomes a clip of its own",
                 .run =
                     [&session]
                 {
                     if (!session.model.splitAt(session.transport.playhead()))
                         return;
                     session.transport.stop();
                     session.viewState.fit();
                 },
                 .can = [&session] { return session.transport.canSplit(); },
                 .keys = {juce::KeyPress('s')}},
                {.id = joinWithNext,
                 .name = "Join with next clip",
                 .help = "Appends the next clip of the project to this one",
                 .run = [&session] { session.model.joinNext(); },
                 .can = [&session] { return session.model.nextClipId() != 0; },
                 .keys = {juce::KeyPress('j')}},
                {.id = keepVersionA,
                 .name = "Keep this version as A",
                 .help = "Keeps the clip as it is now, to compare it with what it becomes",
                 .run = [&session] { session.model.keepVersion(); },
                 .can = anyClip,
                 .keys = {ctrl('k')},
                 .lineBefore = true},
                {.id = compareWithA,
                 .name = "Compare with A",
                 .help = "Shows and plays version A, and the clip again; playing goes on",
                 .run = [&session] { session.model.setComparing(!session.model.isComparing()); },
                 .can = [&session] { return session.model.keptVersion() != nullptr; },
                 .on = [&session] { return session.model.isComparing(); },
                 .keys = {juce::KeyPress('c')}},
                {.id = takeVersionA,
                 .name = "Take version A",
                 .help = "The clip becomes version A",
                 .run =
                     [&session]
                 {
                     const auto kept = session.model.keptVersion();
                     session.model.setComparing(false);
                     session.clipSelection.setEdited("Take version A", {*kept, {}});
                 },
                 .can =
                     [&session]
                 {
                     return session.model.keptVersion() != nullptr;
                 }},
                {.id = duplicateClip,
                 .name = "Duplicate",
                 .help = "Adds a copy of the clip to the project",
                 .run = [&session] { session.model.duplicate(); },
                 .can = anyClip,
                 .keys = {ctrl('d')},
                 .lineBefore = true},
                {.id = removeClip,
                 .name = "Remove",
                 .help = "Removes the clip from the project",
                 .run = [&session] { session.model.removeClip(); },
                 .can = anyClip},
                {.id = nextClip,
                 .name = "Next clip",
                 .help = "Shows the next clip of the project",
                 .run = [&session] { showNext(session); },
                 .can = [&session] { return session.model.document().project().clips.size() > 1; },
                 .keys = {ctrl(juce::KeyPress::pageDownKey)}},
            }};
}

} // namespace pacini::editor
