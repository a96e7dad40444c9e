// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Command ids of the editor, for menus, keys, buttons and tests.

namespace pacini::editor
{

/// The menus implement the commands: FileMenu.cpp, EditMenu.cpp and so on.
enum Command : int
{
    newProject = 1,
    openFile,
    openFolder,
    openRecent,
    openDemo,
    openSample,
    save,
    saveAs,
    exportClips,
    stopWork,
    quit,

    undo,
    redo,
    showHistory,
    cut,
    copy,
    paste,
    deleteSelection,
    selectAll,
    selectKind,
    selectNone,

    changeGain,
    fadeIn,
    fadeOut,
    fadeInSmoothly,
    fadeOutSmoothly,
    invertCurves,
    quantise,
    humanise,
    thinOut,

    reverse,
    trim,
    transposePitch,
    stretch,
    repeatClipTimes,
    splitClipHere,
    joinWithNext,
    keepVersionA,
    compareWithA,
    takeVersionA,
    compareWithTheSound,
    duplicateClip,
    removeClip,
    nextClip,
    previousClip,
    fitToActuator,
    analyseAlike,

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
    hapticOrSound,
    tapEvent,

    addMarker,
    renameMarker,
    deleteMarker,
    nextMarker,
    markerBack,

    zoomIn,
    zoomOut,
    fit,
    zoomToRange,
    tallerLanes,
    lowerLanes,
    decibels,
    draw,
    snap,
    snapTo,
    showWaveform,
    showSpectrum,
    showBoth,
    wholeSpectrum,
    showActuator,
    followOff,
    followPage,
    followSmooth,
    lightLook,
    largerInterface,
    smallerInterface,
    soundDevices,
    hapticOutputs,
    preferences,

    editScene,
    addToScene,
    measureActuator,
    loadProfile,
    runStudy,
    feelOnPhone,

    nextPanel,
    previousPanel,

    searchCommands,
    manual,
    shortcuts,
    about
};

} // namespace pacini::editor
