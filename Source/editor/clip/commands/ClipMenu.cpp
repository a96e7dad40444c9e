// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"

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
