// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/ActuatorTrace.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/commands/Operations.h"
#include "editor/clip/session/ClipSteps.h"
#include "editor/clip/sheets/ComparisonSheet.h"

namespace pacini::editor
{

namespace
{
/// The clip of the project that is `by` further on, round and round.
void showOther(Session& session, std::size_t by)
{
    const auto& items = session.model.document().project().clips;
    for (std::size_t i = 0; i < items.size(); ++i)
        if (items[i]->id == session.model.activeId())
            return session.model.show(items[(i + by) % items.size()]->id);
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
    const auto anyClip = hasClip(session);
    const auto several = [&session]
    {
        return session.model.document().project().clips.size() > 1;
    };
    Menu menu("Clip");
    menu.add(
        trim, "Trim to time range", "Deletes everything outside the time range",
        [&session]
        {
            const auto range = *session.clipSelection.timeRange();
            session.clipSelection.setTimeRange(std::nullopt);
            editClip(session.model, "Trim", TrimEdit{range});
        },
        [&session] { return session.model.clip() && session.clipSelection.timeRange(); }, {ctrl('t')});
    menu.add(
        reverse, "Reverse", "Reverses the clip in time",
        [&session] { editClip(session.model, "Reverse", ReverseEdit{}); }, anyClip);
    menu.add(transposePitch, "Transpose...", "Shifts all frequencies by semitones",
             [&view] { ask(view, transposeOperation()); }, anyClip, {ctrlShift('t')});
    menu.add(
        stretch, "Stretch...", "Changes the length and keeps the pitch",
        [&view] { ask(view, stretchOperation(view.session().model)); }, anyClip);
    menu.add(repeatClipTimes, "Repeat...", "Repeats the clip a number of times",
             [&view] { ask(view, repeatOperation()); }, anyClip, {ctrl('r')});
    menu.add(
        fitToActuator, "Fit to actuator",
        "Adapts levels and frequencies to the range of the chosen actuator, as one step",
        [&session]
        {
            setClip(session.model, "Fit to actuator",
                    fittedClip(*session.model.clip(), *session.actuators.profile(), session.actuators.strength()));
        },
        [&session] { return session.model.clip() && session.actuators.profile(); });
    menu.add(
        feelAlike, "Feel as on...",
        "Changes the clip so that the chosen actuator feels as the one it was designed on, as one step",
        [&view, &session] { ask(view, alikeOperation(session.actuators)); },
        [&session] { return session.model.clip() && hasAlike(session.actuators); });
    menu.add(
        splitClipHere, "Split at playhead", "Moves everything after the playhead to a new clip",
        [&session]
        {
            if (!splitShown(session.model, session.transport.playhead()))
                return;
            session.transport.stop();
            session.viewState.fit();
        },
        [&session] { return session.transport.canSplit(); }, {juce::KeyPress('s')});
    menu.add(
        joinWithNext, "Join with next clip", "Appends the next clip of the project to this one",
        [&session] { joinNext(session.model); }, [&session] { return nextClipId(session.model) != 0; },
        {juce::KeyPress('j')});
    menu.addLine();
    menu.add(keepVersionA, "Store as version A", "Stores the current clip, to compare with later edits",
             [&session] { session.model.keepVersion(); }, anyClip, {ctrl('k')});
    menu.addSwitch(
        compareWithA, "Compare with A", "Switches between version A and the clip, also during playback",
        [&session] { session.model.setComparing(!session.model.isComparing()); },
        [&session] { return session.model.isComparing(); }, {juce::KeyPress('c')},
        [&session] { return session.model.keptVersion() != nullptr; });
    menu.add(
        takeVersionA, "Revert to version A", "Replaces the clip with version A, and the settings of its analysis",
        [&session] { takeVersion(session.model); }, [&session] { return session.model.keptVersion() != nullptr; });
    menu.add(
        analyseAlike, "Analyse selected clips alike",
        "Analyses all clips that are selected in the list with the settings of this one, as one step",
        [&session] { session.sounds.reanalyse(session.model.selectedClips(), session.model.item()->encoder); },
        [&session] {
            return session.model.item() && session.model.item()->source != 0 &&
                   session.model.selectedClips().size() > 1;
        });
    menu.add(
        compareWithTheSound, "Compare with sound...",
        "Shows where the clip differs from its sound, by band and time, with its scores",
        [&view, &session] { view.showSheet(std::make_unique<ComparisonSheet>(session)); },
        [&session] { return session.model.clip() && session.sounds.soundOfClip(); }, {ctrlShift('d')});
    menu.addLine();
    menu.add(duplicateClip, "Duplicate", "Adds a copy of the clip to the project",
             [&session] { duplicateShown(session.model); }, anyClip, {ctrl('d')});
    menu.add(
        removeClip, "Remove", "Removes the clip from the project",
        [&session] { removeClips(session.model, {session.model.activeId()}); }, anyClip);
    menu.add(nextClip, "Next clip", "Shows the next clip of the project", [&session] { showOther(session, 1); },
             several, {ctrl(juce::KeyPress::pageDownKey)});
    menu.add(previousClip, "Previous clip", "Shows the previous clip of the project",
             [&session] { showOther(session, session.model.document().project().clips.size() - 1); }, several,
             {ctrl(juce::KeyPress::pageUpKey)});
    return menu;
}

} // namespace pacini::editor
