// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Names, colours and value texts of lanes.

#include "editor/Theme.h"

#include <pacini/clip/edits/Lane.h>

namespace pacini::editor
{

/// The colour of a lane: bands go through the hues by frequency.
[[nodiscard]] juce::Colour laneColour(const Clip& clip, Lane lane, const Palette& palette, bool dark);

/// "62 Hz", "1.2 kHz".
[[nodiscard]] juce::String hertzText(double frequency);
/// A tick of a time axis whose ticks are `step` apart: "0.5 s", "1:05".
[[nodiscard]] juce::String timeText(double time, double step);
/// "60–125 Hz", "0.50–2.0 kHz".
/// Draws the text of a ruler's tick at `x`, in the font of `g`: at its right, at its left where that would leave
/// `line`, and not at all where it would run into the text before, which ends at `taken`. Returns the end of what is
/// taken then.
int drawTickText(juce::Graphics& g, const juce::String& text, int x, juce::Rectangle<int> line, int taken);

[[nodiscard]] juce::String rangeText(double low, double high);
/// "-12.3 dB", "silent".
[[nodiscard]] juce::String amplitudeText(double amplitude);
/// The name of a lane for people.
[[nodiscard]] juce::String laneName(const Clip& clip, Lane lane);

/// A technical name in the words of designers: "Centroid" is "Brightness". What has no other word stays.
[[nodiscard]] juce::String designerWord(const juce::String& technical);

} // namespace pacini::editor
