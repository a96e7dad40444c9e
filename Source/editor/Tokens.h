// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Design tokens: the colours, type sizes and distances of all windows.

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

/// Colours of one theme. Each has one meaning.
struct Palette
{
    juce::Colour background; ///< of the window
    juce::Colour card;       ///< of panels and bars
    juce::Colour well;       ///< of plots, fields and meters
    juce::Colour control;    ///< of buttons, menus and knobs
    juce::Colour line;       ///< borders, grids and what is not filled
    juce::Colour text;
    juce::Colour dim;       ///< secondary text
    juce::Colour accent;    ///< what is on, has a value or has the keyboard
    juce::Colour onAccent;  ///< text on `accent`
    juce::Colour primary;   ///< the one prominent button of a bar
    juce::Colour onPrimary; ///< text on `primary`
    juce::Colour warning;   ///< warnings, and nothing else
    juce::Colour danger;    ///< what is lost or clips
    juce::Colour event;     ///< transients
    juce::Colour tone;      ///< frequencies
};

// Text on card: contrast 12:1 (dark) and 16:1 (light); secondary text at least 4.5:1 everywhere.
inline const Palette darkPalette{
    .background = juce::Colour(0xff16191d),
    .card = juce::Colour(0xff1f242a),
    .well = juce::Colour(0xff14171b),
    .control = juce::Colour(0xff2a3139),
    .line = juce::Colour(0xff39414b),
    .text = juce::Colour(0xffe6e9ec),
    .dim = juce::Colour(0xff97a1ac),
    .accent = juce::Colour(0xff3fc1a6),
    .onAccent = juce::Colour(0xff10201c),
    .primary = juce::Colour(0xffe6e9ec),
    .onPrimary = juce::Colour(0xff16191d),
    .warning = juce::Colour(0xffe8a33d),
    .danger = juce::Colour(0xffee766b),
    .event = juce::Colour(0xffb497ff),
    .tone = juce::Colour(0xff62aef0),
};
inline const Palette lightPalette{
    .background = juce::Colour(0xffeceef0),
    .card = juce::Colour(0xfffbfcfc),
    .well = juce::Colour(0xffe4e7ea),
    .control = juce::Colour(0xffeef1f4),
    .line = juce::Colour(0xffc6ccd2),
    .text = juce::Colour(0xff1b2026),
    .dim = juce::Colour(0xff5b6570),
    .accent = juce::Colour(0xff0b7360),
    .onAccent = juce::Colour(0xfffbfcfc),
    .primary = juce::Colour(0xff1b2026),
    .onPrimary = juce::Colour(0xfffbfcfc),
    .warning = juce::Colour(0xff955806),
    .danger = juce::Colour(0xffb8322a),
    .event = juce::Colour(0xff6a3fd1),
    .tone = juce::Colour(0xff1b67aa),
};

/// All distances are multiples of this many points.
inline constexpr int grid = 8;

namespace space
{
inline constexpr int controlHeight = 26;
inline constexpr int widestBox = 280; ///< menus are no wider, however wide the window is
inline constexpr int scrollBar = 8;   ///< its track; the thumb is slimmer
inline constexpr float corner = 4.0f; ///< of controls
inline constexpr float cardCorner = 6.0f;
inline constexpr int leastKnob = 32; ///< diameter
inline constexpr int mostKnob = 64;
inline constexpr int leastTrack = 80; ///< length of a slider's track, so that a step of the mouse is a small one
} // namespace space

/// Heights of type, from the top of the highest letter to the bottom of the lowest.
namespace type
{
inline constexpr float caption = 12.0f; ///< marks of scales
inline constexpr float note = 13.5f;    ///< units, notes, labels
inline constexpr float text = 15.0f;
inline constexpr float title = 20.0f;
} // namespace type

} // namespace pacini::editor
