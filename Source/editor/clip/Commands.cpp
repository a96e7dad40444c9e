// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/Commands.h"

namespace pacini::editor
{

std::span<const CommandInfo> commandTable()
{
    using K = juce::KeyPress;
    constexpr int ctrl = juce::ModifierKeys::commandModifier;
    constexpr int shift = juce::ModifierKeys::shiftModifier;
    static const CommandInfo table[] = {
        {newProject, "File", "New project", "Begins an empty project", 'n', ctrl},
        {openFile, "File", "Open...", "Opens sounds, clips of all known formats and projects", 'o', ctrl},
        {openDemo, "File", "Open a demo sound", "Opens one of the sounds that come with Pacini"},
        {save, "File", "Save project", "Writes the project to its file", 's', ctrl, true},
        {saveAs, "File", "Save project as...", "Writes the project to another file", 's', ctrl | shift},
        {exportClips, "File", "Export...", "Writes clips for use elsewhere, in any format", 'e', ctrl, true},
        {quit, "File", "Quit", "Closes the program", 'q', ctrl, true},

        {undo, "Edit", "Undo", "Takes the last step back", 'z', ctrl},
        {redo, "Edit", "Redo", "Takes the last undo back", 'z', ctrl | shift},
        {cut, "Edit", "Cut", "Copies and removes what is selected, or the time range", 'x', ctrl, true},
        {copy, "Edit", "Copy", "Copies what is selected, or the time range of all lanes", 'c', ctrl},
        {paste, "Edit", "Paste at playhead", "Pastes into the lanes it was copied from", 'v', ctrl},
        {deleteSelection, "Edit", "Delete points", "Removes the selected points and transients", K::deleteKey},
        {selectAll, "Edit", "Select all", "Selects all points of the lane with the focus, else all transients", 'a',
         ctrl, true},
        {selectNone, "Edit", "Select nothing", "Selects nothing", 'a', ctrl | shift},
        {fadeIn, "Edit", "Fade in", "Fades in over the selection, the time range or the clip", 0, 0, true},
        {fadeOut, "Edit", "Fade out", "Fades out over the selection, the time range or the clip"},
        {reverse, "Edit", "Reverse clip", "Plays the clip from its end"},
        {trim, "Edit", "Trim to time range", "Keeps the time range only", 't', ctrl},
        {duplicateClip, "Edit", "Duplicate clip", "Adds a copy of the clip to the project", 'd', ctrl, true},
        {removeClip, "Edit", "Remove clip", "Removes the clip from the project"},
        {nextClip, "Edit", "Next clip", "Shows the next clip of the project", K::pageDownKey, ctrl},

        {playOrPause, "Play", "Play or pause", "Starts at the playhead, or stops there", K::spaceKey},
        {toStart, "Play", "To start", "Brings the playhead to the start", K::homeKey},
        {toEnd, "Play", "To end", "Brings the playhead to the end", K::endKey},
        {stepBack, "Play", "Playhead back", "Moves the playhead a tenth of the view back", K::leftKey, ctrl},
        {stepForward, "Play", "Playhead forward", "Moves the playhead a tenth of the view forward", K::rightKey, ctrl},
        {rangeFromHere, "Play", "Range begins here", "The time range begins at the playhead", 'i', 0, true},
        {rangeToHere, "Play", "Range ends here", "The time range ends at the playhead", 'o', 0},
        {loop, "Play", "Loop", "Plays the time range, or the whole clip, again and again", 'l', ctrl},
        {hearHaptic, "Play", "Haptic only", "The drive signal alone", '1', ctrl, true},
        {hearSound, "Play", "Sound only", "The sound alone", '2', ctrl},
        {hearBoth, "Play", "Haptic and sound", "Both, each on its own outputs", '3', ctrl},

        {zoomIn, "View", "Zoom in", "Shows less time", '+'},
        {zoomOut, "View", "Zoom out", "Shows more time", '-'},
        {fit, "View", "Fit clip", "Shows the whole clip", '0'},
        {zoomToRange, "View", "Zoom to range", "Shows the time range, or the selection", 'r'},
        {tallerLanes, "View", "Taller lanes", "Makes lanes taller", '+', ctrl, true},
        {lowerLanes, "View", "Lower lanes", "Makes lanes lower", '-', ctrl},
        {decibels, "View", "Levels in dB", "Levels on a scale of decibels, or linear"},
        {lightLook, "View", "Light colours", "Dark text on light ground", 0, 0, true},
        {largerInterface, "View", "Larger interface", "Everything larger, to twice the size", '+', ctrl | shift},
        {smallerInterface, "View", "Smaller interface", "Everything smaller, to three quarters", '-', ctrl | shift},
        {soundDevices, "View", "Sound devices...", "Chooses the device and its outputs", 0, 0, true},

        {shortcuts, "Help", "Keys and mouse", "Shows what keys and mouse do", K::F1Key},
    };
    return table;
}

} // namespace pacini::editor
