// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All commands of the editor with their places in menus, keys and help.

#include <juce_gui_basics/juce_gui_basics.h>

#include <array>
#include <span>

namespace pacini::editor
{

enum Command : int
{
    newProject = 1,
    openFile,
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
    shortcuts
};

struct CommandInfo
{
    Command id;
    const char* menu; ///< empty: in no menu
    const char* name;
    const char* help;
    int key = 0; ///< 0: none
    int modifiers = 0;
    bool lineBefore = false; ///< in its menu
};

/// In the order of the menus.
[[nodiscard]] std::span<const CommandInfo> commandTable();

inline constexpr std::array<const char*, 5> menuNames{"File", "Edit", "Play", "View", "Help"};

} // namespace pacini::editor
