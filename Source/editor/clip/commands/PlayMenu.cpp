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
    const auto anyClip = [&session]
    {
        return session.model.clip() != nullptr;
    };
    const auto hear = [&session](Command id, const char* name, const char* help, Heard what, char key)
    {
        return Action{.id = id,
                      .name = name,
                      .help = help,
                      .run = [&session, what] { session.transport.setHeard(what); },
                      .on = [&session, what] { return session.transport.heard() == what; },
                      .keys = {ctrl(key)},
                      .lineBefore = what == Heard::haptic};
    };
    using Key = juce::KeyPress;
    return {
        "Play",
        {
            {.id = playOrPause,
             .name = "Play or pause",
             .help = "Starts at the playhead, or stops there",
             .run = [&session] { playOrStop(session); },
             .can = anyClip,
             .keys = {Key(Key::spaceKey)}},
            {.id = toStart,
             .name = "To start",
             .help = "Brings the playhead to the start",
             .run = [&session] { session.transport.setPlayhead(0.0); },
             .can = anyClip,
             .keys = {Key(Key::homeKey)}},
            {.id = toEnd,
             .name = "To end",
             .help = "Brings the playhead to the end",
             .run = [&session] { session.transport.setPlayhead(session.model.clip()->duration); },
             .can = anyClip,
             .keys = {Key(Key::endKey)}},
            {.id = stepBack,
             .name = "Playhead back",
             .help = "Moves the playhead a tenth of the view back",
             .run = [&session] { step(session, -1); },
             .can = anyClip,
             .keys = {ctrl(Key::leftKey)}},
            {.id = stepForward,
             .name = "Playhead forward",
             .help = "Moves the playhead a tenth of the view forward",
             .run = [&session] { step(session, 1); },
             .can = anyClip,
             .keys = {ctrl(Key::rightKey)}},
            {.id = rangeFromHere,
             .name = "Range begins here",
             .help = "The time range begins at the playhead",
             .run = [&session] { beginRange(session); },
             .can = anyClip,
             .keys = {Key('i')},
             .lineBefore = true},
            {.id = rangeToHere,
             .name = "Range ends here",
             .help = "The time range ends at the playhead",
             .run = [&session] { endRange(session); },
             .can = anyClip,
             .keys = {Key('o')}},
            {.id = loop,
             .name = "Loop",
             .help = "Plays the time range, or the whole clip, again and again",
             .run = [&session] { session.transport.setLooping(!session.transport.isLooping()); },
             .on = [&session] { return session.transport.isLooping(); },
             .keys = {ctrl('l')}},
            hear(hearHaptic, "Haptic only", "The drive signal alone", Heard::haptic, '1'),
            hear(hearSound, "Sound only", "The sound alone", Heard::sound, '2'),
            hear(hearBoth, "Haptic and sound", "Both, each on its own outputs", Heard::both, '3'),
            {.id = hapticOrSound,
             .name = "Switch haptic and sound",
             .help = "Switches between them while playing, to compare them",
             .run = [&session]
             { session.transport.setHeard(session.transport.heard() == Heard::haptic ? Heard::sound : Heard::haptic); },
             .can = anyClip,
             .keys = {Key('h')}},
        }};
}

} // namespace pacini::editor
