// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/TimeRows.h"

#include "document/view/Columns.h"
#include "editor/Theme.h"
#include "editor/clip/PlotLane.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr double leastTickDistance = 90.0; // pixels between two times

/// A round number of seconds for the distance of ticks.
double tickStep(double secondsPerPixel)
{
    const double least = secondsPerPixel * leastTickDistance;
    constexpr std::array<double, 6> minutes{60.0, 120.0, 300.0, 600.0, 1800.0, 3600.0};
    if (least > 30.0)
    {
        for (double step : minutes)
            if (step >= least)
                return step;
        return 3600.0 * std::ceil(least / 3600.0);
    }
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (double factor : {1.0, 2.0, 5.0})
        if (factor * power >= least * 0.999)
            return factor * power;
    return least > 20.0 && 10.0 * power >= 60.0 ? 60.0 : 10.0 * power;
}

juce::String timeText(double time, double step)
{
    const int decimals = step >= 1.0 ? 0 : static_cast<int>(std::ceil(-std::log10(step) - 1e-9));
    const auto number = [decimals](double value)
    {
        return decimals > 0 ? juce::String(value, decimals) : juce::String(juce::roundToInt(value));
    };
    if (time < 60.0)
        return number(time) + " s";
    const int minutes = static_cast<int>(time / 60.0 + 1e-9);
    const auto seconds = number(std::max(0.0, time - 60.0 * minutes));
    return juce::String(minutes) + ":" + (seconds.indexOfChar('.') == 1 || seconds.length() == 1 ? "0" : "") + seconds;
}
} // namespace

TimeRuler::TimeRuler(Session& shared) : session(shared)
{
    setOpaque(true);
    setTitle("Time ruler");
    setTooltip("Click: playhead. Drag: time range for loops and edits. Double-click: no range");
    session.listeners.add(this);
}

TimeRuler::~TimeRuler()
{
    session.listeners.remove(this);
}

void TimeRuler::sessionChanged(unsigned changes)
{
    if ((changes & (Session::view | Session::range | Session::content)) != 0)
        repaint();
}

double TimeRuler::timeAt(float x) const
{
    return session.axis().timeAt(static_cast<double>(x) - laneHeadWidth);
}

void TimeRuler::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.card);
    const auto plot = getLocalBounds().withTrimmedLeft(laneHeadWidth);
    const TimeAxis& axis = session.axis();
    const juce::Graphics::ScopedSaveState saved(g);
    g.reduceClipRegion(plot);
    const auto xOf = [&](double time)
    {
        return static_cast<float>(plot.getX() + axis.xOf(time));
    };
    if (const auto& range = session.timeRange())
    {
        g.setColour(session.isLooping() ? p.accent : p.accent.withAlpha(0.45f));
        g.fillRect(juce::Rectangle<float>(xOf(range->from), static_cast<float>(plot.getBottom() - 6),
                                          std::max(1.0f, xOf(range->to) - xOf(range->from)), 6.0f));
    }
    const double step = tickStep(axis.secondsPerPixel);
    const auto first = static_cast<long long>(std::floor(axis.start / step));
    const auto last = static_cast<long long>(std::ceil(axis.timeAt(plot.getWidth()) / step));
    g.setFont(smallFont());
    for (long long i = std::max(0LL, first); i <= last; ++i)
    {
        const double time = static_cast<double>(i) * step;
        const float x = xOf(time);
        g.setColour(p.line);
        g.fillRect(x, 4.0f, 1.0f, static_cast<float>(plot.getHeight() - 4));
        for (int k = 1; k < 5; ++k)
            g.fillRect(xOf(time + k * step / 5.0), static_cast<float>(plot.getBottom() - 5), 1.0f, 5.0f);
        g.setColour(p.dim);
        g.drawText(timeText(time, step), juce::roundToInt(x) + 4, 0, 80, plot.getHeight() - 5,
                   juce::Justification::centredLeft, false);
    }
}

void TimeRuler::mouseDown(const juce::MouseEvent& event)
{
    anchor = timeAt(event.position.x);
    if (event.getNumberOfClicks() == 1)
        session.setPlayhead(anchor);
}

void TimeRuler::mouseDrag(const juce::MouseEvent& event)
{
    if (!event.mouseWasDraggedSinceMouseDown())
        return;
    const double now = timeAt(event.position.x);
    session.setTimeRange(TimeRange{std::min(anchor, now), std::max(anchor, now)});
}

void TimeRuler::mouseDoubleClick(const juce::MouseEvent&)
{
    session.setTimeRange(std::nullopt);
}

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

Overview::Overview(Session& shared) : session(shared)
{
    setOpaque(true);
    setTitle("Overview");
    setTooltip("The whole clip. Drag the frame to scroll, its edges to zoom; double-click shows everything");
    session.listeners.add(this);
}

Overview::~Overview()
{
    session.listeners.remove(this);
}

void Overview::sessionChanged(unsigned changes)
{
    if ((changes & (Session::view | Session::content)) != 0)
        repaint();
}

TimeAxis Overview::whole() const
{
    const auto clip = session.clip();
    return TimeAxis::showing({0.0, clip ? std::max(1e-3, clip->duration) : 1.0}, getWidth() - laneHeadWidth);
}

juce::Rectangle<float> Overview::frame() const
{
    const auto plot = getLocalBounds().withTrimmedLeft(laneHeadWidth).toFloat();
    const TimeAxis axis = whole();
    const TimeRange shown = session.axis().visible(session.viewWidth());
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
    g.drawText("Overview", getLocalBounds().withWidth(laneHeadWidth).withTrimmedLeft(grid + 3),
               juce::Justification::centredLeft);
    g.setColour(p.well);
    g.fillRect(plot);
    const auto clip = session.clip();
    if (!clip)
        return;
    std::vector<Column> columns(static_cast<std::size_t>(std::max(0, plot.getWidth())));
    curveColumns(clip->envelope, whole(), columns);
    double highest = 1e-6;
    for (const Column& column : columns)
        highest = std::max(highest, static_cast<double>(column.high));
    g.setColour(p.dim.withAlpha(0.7f));
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
        const int height = juce::roundToInt(static_cast<double>(columns[i].high) / highest * (plot.getHeight() - 4));
        g.fillRect(plot.getX() + static_cast<int>(i), plot.getBottom() - height, 1, height);
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
    before = session.axis().visible(session.viewWidth());
    drag = std::abs(event.position.x - shown.getX()) < edge       ? Drag::left
           : std::abs(event.position.x - shown.getRight()) < edge ? Drag::right
                                                                  : Drag::frame;
    if (drag != Drag::frame || shown.contains(event.position))
        return;
    // A click beside the frame brings it there.
    TimeAxis axis = session.axis();
    axis.start =
        whole().timeAt(static_cast<double>(event.position.x) - laneHeadWidth) - 0.5 * (before.to - before.from);
    session.setAxis(axis);
    before = session.axis().visible(session.viewWidth());
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
        TimeAxis axis = session.axis();
        axis.start = wanted.from;
        session.setAxis(axis);
        return;
    }
    session.showRange(wanted);
}

void Overview::mouseDoubleClick(const juce::MouseEvent&)
{
    session.fit();
}

} // namespace pacini::editor
