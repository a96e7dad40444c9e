// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"

namespace pacini::editor
{

namespace
{
void playOrStop(Session& session)
{
    if (!session.transport.isPlaying())
        return session.transport.play();
    const double here = session.transport.playhead();
    session.transport.stop();
    session.transport.setPlayhead(here);
}

/// Tenths of what is visible.
void step(Session& session, int tenths)
{
    session.transport.setPlayhead(session.transport.playhead() + 0.1 * tenths * session.viewState.viewWidth() *
                                                                     session.viewState.axis().secondsPerPixel);
}

TimeRange rangeOrAll(const Session& session)
{
    return session.clipSelection.timeRange().value_or(TimeRange{0.0, session.model.clip()->duration});
}

void beginRange(Session& session)
{
    const double here = session.transport.playhead();
    const TimeRange range = rangeOrAll(session);
    session.clipSelection.setTimeRange(TimeRange{here, range.to > here ? range.to : session.model.clip()->duration});
}

void endRange(Session& session)
{
    const double here = session.transport.playhead();
    const TimeRange range = rangeOrAll(session);
    session.clipSelection.setTimeRange(TimeRange{range.from < here ? range.from : 0.0, here});
}
} // namespace

Menu playMenu(EditorView& view)
{
    Session& session = view.session();
    const auto anyClip = hasClip(session);
    using Key = juce::KeyPress;
    Menu menu("Play");
    const auto hear = [&session, &menu](Command id, const char* name, const char* help, Heard what, char key)
    {
        menu.addSwitch(
            id, name, help, [&session, what] { session.transport.setHeard(what); },
            [&session, what] { return session.transport.heard() == what; }, {ctrl(key)});
    };
    menu.add(playOrPause, "Play or pause", "Starts at the playhead, or stops there",
             [&session] { playOrStop(session); }, anyClip, {Key(Key::spaceKey)});
    menu.add(toStart, "To start", "Brings the playhead to the start",
             [&session] { session.transport.setPlayhead(0.0); }, anyClip, {Key(Key::homeKey)});
    menu.add(toEnd, "To end", "Brings the playhead to the end",
             [&session] { session.transport.setPlayhead(session.model.clip()->duration); }, anyClip,
             {Key(Key::endKey)});
    menu.add(stepBack, "Playhead back", "Moves the playhead a tenth of the view back",
             [&session] { step(session, -1); }, anyClip, {ctrl(Key::leftKey)});
    menu.add(stepForward, "Playhead forward", "Moves the playhead a tenth of the view forward",
             [&session] { step(session, 1); }, anyClip, {ctrl(Key::rightKey)});
    menu.addLine();
    menu.add(rangeFromHere, "Range begins here", "The time range begins at the playhead",
             [&session] { beginRange(session); }, anyClip, {Key('i')});
    menu.add(rangeToHere, "Range ends here", "The time range ends at the playhead", [&session] { endRange(session); },
             anyClip, {Key('o')});
    menu.addSwitch(
        loop, "Loop", "Plays the time range, or the whole clip, again and again",
        [&session] { session.transport.setLooping(!session.transport.isLooping()); },
        [&session] { return session.transport.isLooping(); }, {ctrl('l')});
    menu.addLine();
    hear(hearHaptic, "Haptic only", "The drive signal alone", Heard::haptic, '1');
    hear(hearSound, "Sound only", "The sound alone", Heard::sound, '2');
    hear(hearBoth, "Haptic and sound", "Both, each on its own outputs", Heard::both, '3');
    menu.add(hapticOrSound, "Switch haptic and sound", "Switches between them while playing, to compare them",
             [&session]
             { session.transport.setHeard(session.transport.heard() == Heard::haptic ? Heard::sound : Heard::haptic); },
             anyClip, {Key('h')});
    return menu;
}

} // namespace pacini::editor
