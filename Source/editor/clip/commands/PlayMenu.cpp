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
    session.transport.scrub(session.transport.playhead() +
                            0.1 * tenths * session.viewState.viewWidth() * session.viewState.axis().secondsPerPixel);
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
    menu.add(playOrPause, "Play/pause", "Plays from the playhead, or pauses", [&session] { playOrStop(session); },
             anyClip, {Key(Key::spaceKey)});
    menu.add(toStart, "Go to start", "Moves the playhead to the start",
             [&session] { session.transport.setPlayhead(0.0); }, anyClip, {Key(Key::homeKey)});
    menu.add(toEnd, "Go to end", "Moves the playhead to the end",
             [&session] { session.transport.setPlayhead(session.model.clip()->duration); }, anyClip,
             {Key(Key::endKey)});
    menu.add(stepBack, "Move playhead left", "Moves the playhead left by a tenth of the view",
             [&session] { step(session, -1); }, anyClip, {ctrl(Key::leftKey)});
    menu.add(stepForward, "Move playhead right", "Moves the playhead right by a tenth of the view",
             [&session] { step(session, 1); }, anyClip, {ctrl(Key::rightKey)});
    menu.addLine();
    menu.add(rangeFromHere, "Set range start", "Starts the time range at the playhead",
             [&session] { beginRange(session); }, anyClip, {Key('i')});
    menu.add(rangeToHere, "Set range end", "Ends the time range at the playhead", [&session] { endRange(session); },
             anyClip, {Key('o')});
    menu.addSwitch(
        loop, "Loop", "Repeats the time range or the whole clip",
        [&session] { session.transport.setLooping(!session.transport.isLooping()); },
        [&session] { return session.transport.isLooping(); }, {ctrl('l')});
    menu.addLine();
    menu.add(tapEvent, "Tap an event",
             "Adds an event at the playhead; during playback also by MIDI pads and game controllers",
             [&session] { session.tapping.tap(); }, anyClip, {Key('t')});
    menu.addLine();
    hear(hearHaptic, "Haptic only", "Plays only the drive signal", Heard::haptic, '1');
    hear(hearSound, "Sound only", "Plays only the sound", Heard::sound, '2');
    hear(hearBoth, "Haptic and sound", "Plays both, each on its own outputs", Heard::both, '3');
    menu.add(hapticOrSound, "Toggle haptic/sound", "Switches between haptic and sound to compare them",
             [&session]
             { session.transport.setHeard(session.transport.heard() == Heard::haptic ? Heard::sound : Heard::haptic); },
             anyClip, {Key('h')});
    return menu;
}

} // namespace pacini::editor
