// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/WaveformRow.h"

#include "document/view/Columns.h"
#include "editor/Theme.h"
#include "editor/clip/lanes/PlotLane.h"

#include <algorithm>
#include <vector>

namespace pacini::editor
{

WaveformRow::WaveformRow(Session& shared) : session(shared)
{
    setOpaque(true);
    setTitle("Waveform of the sound");
    setTooltip("The sound that the clip was made from, mean of its channels, -1 to 1");
    session.listeners.add(this);
}

WaveformRow::~WaveformRow()
{
    session.listeners.remove(this);
}

void WaveformRow::sessionChanged(unsigned changes)
{
    if ((changes & (Session::view | Session::range | Session::content | Session::sound)) != 0)
        repaint();
}

void WaveformRow::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.card);
    const auto plot = getLocalBounds().withTrimmedLeft(laneHeadWidth).withTrimmedBottom(1);
    const auto sound = session.soundOfClip();
    if (g.getClipBounds().getX() < plot.getX())
    {
        g.setColour(p.dim);
        g.fillRect(0, 0, 3, plot.getHeight());
        auto head = getLocalBounds()
                        .withWidth(laneHeadWidth)
                        .withTrimmedLeft(grid + 3)
                        .withSizeKeepingCentre(laneHeadWidth - grid - 7, 36);
        g.setColour(p.text);
        g.setFont(usualFont());
        g.drawFittedText("Sound", head.removeFromTop(19), juce::Justification::centredLeft, 1);
        g.setColour(p.dim);
        g.setFont(smallFont());
        g.drawFittedText(sound ? juce::String(sound->audio.sampleRate / 1000.0, 1) + " kHz, " +
                                     juce::String(sound->audio.channels) + " ch"
                               : juce::String("none"),
                         head, juce::Justification::centredLeft, 1);
    }
    g.setColour(p.line);
    g.fillRect(getLocalBounds().removeFromBottom(1));
    const auto visible = g.getClipBounds().getIntersection(plot);
    g.setColour(p.well);
    g.fillRect(visible);
    if (!sound || visible.isEmpty())
        return;
    TimeAxis axis = session.axis();
    axis.start = axis.timeAt(visible.getX() - plot.getX());
    std::vector<Column> columns(static_cast<std::size_t>(visible.getWidth()));
    sound->peaks.columns(axis, columns);
    const float middle = static_cast<float>(plot.getCentreY());
    const float half = 0.5f * static_cast<float>(plot.getHeight() - 4);
    g.setColour(p.line);
    g.fillRect(visible.getX(), plot.getCentreY(), visible.getWidth(), 1);
    g.setColour(p.dim);
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
        const int top = juce::roundToInt(middle - half * std::clamp(columns[i].high, -1.0f, 1.0f));
        const int bottom = juce::roundToInt(middle - half * std::clamp(columns[i].low, -1.0f, 1.0f));
        if (columns[i] == Column{})
            continue;
        g.fillRect(visible.getX() + static_cast<int>(i), top, 1, std::max(1, bottom - top));
    }
}

} // namespace pacini::editor
