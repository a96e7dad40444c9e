// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/Overview.h"

#include "document/view/Columns.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/lanes/ColumnFill.h"
#include "editor/clip/lanes/PlotLane.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace pacini::editor
{

Overview::Overview(const EditorModel& project, ViewState& sight) : model(project), viewState(sight)
{
    setOpaque(true);
    setTitle("Overview");
    setTooltip("The whole clip. Drag the frame to scroll, its edges to zoom; double-click to fit");
    subscriptions.on({&viewState.axisChanged}, [this] { repaint(); });
    subscriptions.on({&model.contentChanged},
                     [this]
                     {
                         const auto last = std::exchange(drawn, model.clip());
                         if (!last || !drawn || last->duration != drawn->duration ||
                             last->envelope != drawn->envelope || (drawn->envelope.empty() && last != drawn))
                             repaint();
                     });
}

TimeAxis Overview::whole() const
{
    const auto clip = model.clip();
    return TimeAxis::showing({0.0, clip ? std::max(1e-3, clip->duration) : 1.0}, getWidth() - laneHeadWidth);
}

juce::Rectangle<float> Overview::frame() const
{
    const auto plot = getLocalBounds().withTrimmedLeft(laneHeadWidth).toFloat();
    const TimeAxis axis = whole();
    const TimeRange shown = viewState.axis().visible(viewState.viewWidth());
    const float left = plot.getX() + static_cast<float>(axis.xOf(shown.from));
    const float right = std::min(plot.getRight(), plot.getX() + static_cast<float>(axis.xOf(shown.to)));
    return plot.withLeft(left).withRight(std::max(left + 4.0f, right)).reduced(0.0f, 1.0f);
}

void Overview::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.card);
    const auto plot = getLocalBounds().withTrimmedLeft(laneHeadWidth);
    g.setColour(p.dim);
    g.setFont(smallFont());
    g.drawText(tr("Overview"), getLocalBounds().withWidth(laneHeadWidth).withTrimmedLeft(grid + 3),
               juce::Justification::centredLeft);
    g.setColour(p.well);
    g.fillRect(plot);
    const auto clip = model.clip();
    if (!clip)
        return;
    std::vector<Column> columns(static_cast<std::size_t>(std::max(0, plot.getWidth())));
    curveColumns(levels.of(clip), whole(), columns);
    double highest = 1e-6;
    for (const Column& column : columns)
        highest = std::max(highest, static_cast<double>(column.high));
    {
        ColumnFill level(g, p.dim.withAlpha(0.7f));
        for (std::size_t i = 0; i < columns.size(); ++i)
        {
            const int height =
                juce::roundToInt(static_cast<double>(columns[i].high) / highest * (plot.getHeight() - 4));
            level.add(plot.getX() + static_cast<int>(i), plot.getBottom() - height, height);
        }
    }
    const auto shown = frame();
    g.setColour(p.background.withAlpha(0.6f));
    g.fillRect(plot.toFloat().withRight(shown.getX()));
    g.fillRect(plot.toFloat().withLeft(shown.getRight()));
    g.setColour(p.accent);
    g.drawRoundedRectangle(shown.reduced(0.5f), 3.0f, 1.5f);
}

void Overview::mouseDown(const juce::MouseEvent& event)
{
    constexpr float edge = 6.0f;
    const auto shown = frame();
    before = viewState.axis().visible(viewState.viewWidth());
    drag = std::abs(event.position.x - shown.getX()) < edge       ? Drag::left
           : std::abs(event.position.x - shown.getRight()) < edge ? Drag::right
                                                                  : Drag::frame;
    if (drag != Drag::frame || shown.contains(event.position))
        return;
    // A click beside the frame brings it there.
    TimeAxis axis = viewState.axis();
    axis.start =
        whole().timeAt(static_cast<double>(event.position.x) - laneHeadWidth) - 0.5 * (before.to - before.from);
    viewState.setAxis(axis);
    before = viewState.axis().visible(viewState.viewWidth());
}

void Overview::mouseDrag(const juce::MouseEvent& event)
{
    const double shift = event.getDistanceFromDragStartX() * whole().secondsPerPixel;
    TimeRange wanted = before;
    if (drag != Drag::right)
        wanted.from += shift;
    if (drag != Drag::left)
        wanted.to += shift;
    if (drag == Drag::frame)
    {
        TimeAxis axis = viewState.axis();
        axis.start = wanted.from;
        viewState.setAxis(axis);
        return;
    }
    viewState.showRange(wanted);
}

void Overview::mouseDoubleClick(const juce::MouseEvent&)
{
    viewState.fit();
}

std::vector<Command> Overview::contextCommands() const
{
    return {zoomIn, zoomOut, zoomToRange, editor::fit};
}

} // namespace pacini::editor
