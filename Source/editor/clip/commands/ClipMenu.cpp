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
    const auto& items = session.document().project().clips;
    for (std::size_t i = 0; i < items.size(); ++i)
        if (items[i]->id == session.activeId())
            return session.show(items[(i + 1) % items.size()]->id);
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
        return session.clip() != nullptr;
    };
    return {"Clip",
            {
                {.id = trim,
                 .name = "Trim to time range",
                 .help = "Keeps the time range only",
                 .run =
                     [&session]
                 {
                     const auto range = *session.timeRange();
                     session.setTimeRange(std::nullopt);
                     session.edit("Trim", TrimEdit{range});
                 },
                 .can = [&session] { return session.clip() && session.timeRange(); },
                 .keys = {ctrl('t')}},
                {.id = reverse,
                 .name = "Reverse",
                 .help = "Plays the clip from its end",
                 .run = [&session] { session.edit("Reverse", ReverseEdit{}); },
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
                 .run = [&view] { ask(view, stretchOperation(view.session())); },
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
                 .run = [&session] { session.split(); },
                 .can = [&session] { return session.canSplit(); },
                 .keys = {juce::KeyPress('s')}},
                {.id = joinWithNext,
                 .name = "Join with next clip",
                 .help = "Appends the next clip of the project to this one",
                 .run = [&session] { session.joinNext(); },
                 .can = [&session] { return session.nextClipId() != 0; },
                 .keys = {juce::KeyPress('j')}},
                {.id = keepVersionA,
                 .name = "Keep this version as A",
                 .help = "Keeps the clip as it is now, to compare it with what it becomes",
                 .run = [&session] { session.keepVersion(); },
                 .can = anyClip,
                 .keys = {ctrl('k')},
                 .lineBefore = true},
                {.id = compareWithA,
                 .name = "Compare with A",
                 .help = "Shows and plays version A, and the clip again; playing goes on",
                 .run = [&session] { session.setComparing(!session.isComparing()); },
                 .can = [&session] { return session.keptVersion() != nullptr; },
                 .on = [&session] { return session.isComparing(); },
                 .keys = {juce::KeyPress('c')}},
                {.id = takeVersionA,
                 .name = "Take version A",
                 .help = "The clip becomes version A",
                 .run = [&session] { session.takeKeptVersion(); },
                 .can =
                     [&session]
                 {
                     return session.keptVersion() != nullptr;
                 }},
                {.id = duplicateClip,
                 .name = "Duplicate",
                 .help = "Adds a copy of the clip to the project",
                 .run = [&session] { session.duplicate(); },
                 .can = anyClip,
                 .keys = {ctrl('d')},
                 .lineBefore = true},
                {.id = removeClip,
                 .name = "Remove",
                 .help = "Removes the clip from the project",
                 .run = [&session] { session.removeClip(); },
                 .can = anyClip},
                {.id = nextClip,
                 .name = "Next clip",
                 .help = "Shows the next clip of the project",
                 .run = [&session] { showNext(session); },
                 .can = [&session] { return session.document().project().clips.size() > 1; },
                 .keys = {ctrl(juce::KeyPress::pageDownKey)}},
            }};
}

} // namespace pacini::editor
