// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/BandView.h"

#include "editor/Theme.h"
#include "editor/Translation.h"

#include <pacini/filters/BandLayout.h>

#include <algorithm>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr int valueWidth = 6 * grid;
constexpr int eventHeight = 2 * grid;

juce::String frequencyText(double hertz)
{
    return juce::String(static_cast<int>(std::lround(hertz))) + " Hz";
}

/// Of the names beside the plot, with the gap behind them.
int nameWidth()
{
    constexpr double longest = 1000.0; // Hz
    const juce::Font font = smallFont();
    return std::max({7 * grid, font.getStringWidth(frequencyText(longest)) + grid + 4,
                     font.getStringWidth(tr("Events")) + grid + 4});
}
} // namespace

BandView::BandView()
{
    setTitle("Bands");
    setDescription("Band levels and events over the last seconds");
    setOpaque(false);
}

const BandView::Column& BandView::columnAt(std::size_t age) const noexcept
{
    return ring[(newest + columns - age) % columns];
}

void BandView::add(const TranslatorMeterReading& reading)
{
    Column column;
    bool anything = false;
    for (std::size_t k = 0; k < reading.bands; ++k)
    {
        const auto level = static_cast<float>(std::max(reading.bandLevels[k], -200.0));
        column.levels[k] = juce::jlimit(0.0f, 1.0f, 1.0f - level / floorLevel);
        anything = anything || column.levels[k] > 0.0f;
    }
    if (begun && reading.events != events)
    {
        column.event = static_cast<float>(std::clamp(reading.lastEventLevel, 0.15, 1.0));
        anything = true;
    }
    const bool otherBands = bands != reading.bands;
    events = reading.events;
    begun = true;
    bands = reading.bands;
    silent = anything ? 0 : std::min(silent + 1, columns);
    newest = (newest + 1) % columns;
    ring[newest] = column;
    if (silent < columns || otherBands)
        repaint();
}

void BandView::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    auto area = getLocalBounds();
    const int labelWidth = nameWidth();
    g.setColour(p.well);
    const auto plot = area.withTrimmedLeft(labelWidth).withTrimmedRight(valueWidth);
    g.fillRoundedRectangle(plot.toFloat(), 4.0f);
    const auto eventLane = area.removeFromTop(eventHeight);
    g.setFont(smallFont());
    g.setColour(p.dim);
    g.drawText(tr("Events"), eventLane.withWidth(labelWidth - grid), juce::Justification::centredRight, false);

    const float step = static_cast<float>(plot.getWidth()) / static_cast<float>(columns);
    g.setColour(p.event);
    for (std::size_t age = 0; age < columns; ++age)
        if (const float event = columnAt(age).event; event > 0.0f)
        {
            const float height = event * static_cast<float>(eventHeight - 4);
            g.fillRect(juce::Rectangle<float>(static_cast<float>(plot.getRight()) - step * static_cast<float>(age + 1),
                                              static_cast<float>(eventLane.getBottom()) - height, 2.0f, height));
        }
    if (bands == 0)
        return;
    const auto layout = designBandLayout({.bands = bands});
    const float laneHeight = static_cast<float>(area.getHeight()) / static_cast<float>(bands);
    for (std::size_t k = 0; k < bands; ++k)
    {
        const float top = static_cast<float>(area.getY()) + laneHeight * static_cast<float>(bands - 1 - k);
        const auto row = juce::Rectangle<float>(0.0f, top, static_cast<float>(getWidth()), laneHeight);
        g.setColour(p.dim);
        g.setFont(smallFont());
        g.drawText(frequencyText(layout.centres[k].value), row.withWidth(static_cast<float>(labelWidth - grid)),
                   juce::Justification::centredRight, false);
        const float level = columnAt(0).levels[k];
        g.setColour(level > 0.0f ? p.text : p.dim);
        g.drawText(level > 0.0f ? juce::String(static_cast<int>(std::lround((1.0f - level) * floorLevel))) + " dB"
                                : juce::String::fromUTF8("–"),
                   row.withTrimmedLeft(static_cast<float>(getWidth() - valueWidth)), juce::Justification::centredRight,
                   false);
        paintLane(g, row.withX(static_cast<float>(plot.getX())).withWidth(static_cast<float>(plot.getWidth())), k);
    }
}

void BandView::paintLane(juce::Graphics& g, juce::Rectangle<float> lane, std::size_t band) const
{
    const Palette& p = paletteFor(*this);
    g.setColour(p.line.withAlpha(0.5f));
    g.fillRect(lane.withHeight(1.0f));
    if (silent >= columns)
        return;
    const auto curve = lane.withTrimmedTop(3.0f);
    const float step = lane.getWidth() / static_cast<float>(columns - 1);
    juce::Path line;
    line.preallocateSpace(static_cast<int>(3 * columns + 16));
    for (std::size_t age = 0; age < columns; ++age)
    {
        const float x = curve.getRight() - step * static_cast<float>(age);
        const float y = curve.getBottom() - columnAt(age).levels[band] * curve.getHeight();
        if (age == 0)
            line.startNewSubPath(x, y);
        else
            line.lineTo(x, y);
    }
    juce::Path fill(line);
    fill.lineTo(curve.getX(), curve.getBottom());
    fill.lineTo(curve.getRight(), curve.getBottom());
    fill.closeSubPath();
    g.setColour(p.accent.withAlpha(0.22f));
    g.fillPath(fill);
    g.setColour(p.accent);
    g.strokePath(line, juce::PathStrokeType(1.3f));
}

} // namespace pacini::editor
