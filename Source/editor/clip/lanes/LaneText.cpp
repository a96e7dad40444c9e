// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/LaneText.h"

#include "editor/Text.h"
#include "editor/Translation.h"

#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pacini::editor
{

juce::Colour laneColour(const Clip& clip, Lane lane, const Palette& palette, bool dark)
{
    if (lane.kind == LaneKind::envelope)
        return palette.accent;
    if (lane.kind == LaneKind::centroid)
        return palette.tone;
    if (lane.kind == LaneKind::noise || clip.bands.empty())
        return palette.dim;
    const float place = static_cast<float>(lane.index) / static_cast<float>(clip.bands.size());
    const float hue = 0.98f - 0.5f * place; // low ones warm, high ones cold
    return juce::Colour::fromHSV(hue < 0.0f ? hue + 1.0f : hue, dark ? 0.45f : 0.75f, dark ? 0.92f : 0.62f, 1.0f);
}

juce::String hertzText(double frequency)
{
    if (frequency >= 1000.0)
        return numberText(frequency / 1000.0, 2) + " kHz";
    return (frequency < 100.0 ? numberText(frequency, 1) : juce::String(juce::roundToInt(frequency))) + " Hz";
}

juce::String timeText(double time, double step)
{
    const int decimals = step >= 1.0 ? 0 : static_cast<int>(std::ceil(-std::log10(step) - 1e-9));
    if (time < 60.0)
        return numberText(time, decimals) + " s";
    const int minutes = static_cast<int>(time / 60.0 + 1e-9);
    const double seconds = std::max(0.0, time - 60.0 * minutes);
    // Two digits before the decimal mark, whatever that is.
    const juce::String text = numberText(seconds, decimals);
    const bool one = text.length() == (decimals > 0 ? decimals + 2 : 1);
    return juce::String(minutes) + (one ? ":0" : ":") + text;
}

int drawTickText(juce::Graphics& g, const juce::String& text, int x, juce::Rectangle<int> line, int taken)
{
    constexpr int gap = 4;
    const int width = g.getCurrentFont().getStringWidth(text) + 1;
    if (x > line.getRight())
        return taken; // the tick is out of sight
    const bool fits = x + gap + width <= line.getRight();
    const int from = fits ? x + gap : x - gap - width;
    if (!fits && from < taken + gap)
        return taken;
    g.drawText(text, from, line.getY(), width, line.getHeight(), juce::Justification::centredLeft, false);
    return from + width;
}

juce::String rangeText(double low, double high)
{
    if (high < 1000.0)
        return juce::String(juce::roundToInt(low)) + toText("–") + juce::String(juce::roundToInt(high)) + " Hz";
    const auto kilo = [](double f)
    {
        return numberText(f / 1000.0, f < 1000.0 ? 2 : 1);
    };
    return kilo(low) + toText("–") + kilo(high) + " kHz";
}

juce::String amplitudeText(double amplitude)
{
    if (amplitude <= 0.0)
        return tr("silent");
    return numberText(Decibels::fromGain(amplitude).value, 1) + " dB";
}

juce::String laneName(const Clip& clip, Lane lane)
{
    switch (lane.kind)
    {
    case LaneKind::envelope:
        return tr("Envelope");
    case LaneKind::centroid:
        return tr("Centroid");
    case LaneKind::noise:
        return lane.index < clip.noise.size()
                   ? tr("Noise {0}",
                        {rangeText(clip.noise[lane.index].lowFrequency, clip.noise[lane.index].highFrequency)})
                   : tr("Noise");
    default:
        return lane.index < clip.bands.size() ? hertzText(clip.bands[lane.index].centreFrequency) : juce::String();
    }
}

juce::String designerWord(const juce::String& technical)
{
    constexpr std::array<std::pair<const char*, const char*>, 3> words{
        {{"Transients", "Events"}, {"Envelope", "Intensity"}, {"Centroid", "Brightness"}}};
    for (const auto& [term, word] : words)
        if (technical == term || technical == tr(term))
            return tr(word);
    return technical;
}

} // namespace pacini::editor
