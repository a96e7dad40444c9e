// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What can be done in the editor, by menu, key, button or test.

namespace pacini::editor
{

/// What each does stands with its menu: FileMenu.cpp, EditMenu.cpp and so on.
enum Command : int
{
    newProject = 1,
    openFile,
    openRecent,
    openDemo,
    save,
    saveAs,
    exportClips,
    quit,

    undo,
    redo,
    cut,
    copy,
    paste,
    deleteSelection,
    selectAll,
    selectNone,
    fadeIn,
    fadeOut,

    reverse,
    trim,
    duplicateClip,
    removeClip,
    nextClip,

    playOrPause,
    toStart,
    toEnd,
    stepBack,
    stepForward,
    rangeFromHere,
    rangeToHere,
    loop,
    hearHaptic,
    hearSound,
    hearBoth,

    zoomIn,
    zoomOut,
    fit,
    zoomToRange,
    tallerLanes,
    lowerLanes,
    decibels,
    lightLook,
    largerInterface,
    smallerInterface,
    soundDevices,

    measureActuator,

    shortcuts
};

} // namespace pacini::editor
