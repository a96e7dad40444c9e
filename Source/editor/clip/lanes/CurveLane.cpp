// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/CurveLane.h"

#include "document/view/Columns.h"
#include "document/view/HitTest.h"
#include "document/view/SoundBrightness.h"
#include "editor/Controls.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/lanes/ColumnFill.h"
#include "editor/clip/lanes/LaneText.h"
#include "editor/clip/session/ClipSteps.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr float pickRadius = 7.0f;         // pixels
constexpr double pixelsForHandles = 5.0;   // a point, on average
constexpr float straightPixels = 8.0f;     // of a line that bends
constexpr double maxPointsPerColumn = 0.2; // on average; more are drawn as bars

/// Points from `first` to behind `last` whose lines reach into a stretch of time.
std::pair<std::size_t, std::size_t> reaching(const Curve& curve, TimeRange range)
{
    const auto less = [](const Breakpoint& p, double t)
    {
        return p.time < t;
    };
    auto first = std::lower_bound(curve.begin(), curve.end(), range.from, less);
    auto last = std::lower_bound(first, curve.end(), range.to, less);
    if (first != curve.begin())
        --first;
    if (last != curve.end())
        ++last;
    return {static_cast<std::size_t>(first - curve.begin()), static_cast<std::size_t>(last - curve.begin())};
}

constexpr double lineReach = 7.0; // pixels
} // namespace

CurveLane::CurveLane(EditorModel& project, ClipSelection& selected, ViewState& sight, Transport& playing, Lane first)
    : PlotLane(project, selected, sight, playing), shown(first), pitchButton("Hz"), soloButton("S"), muteButton("M")
{
    const auto clip = model.clip();
    const juce::String name = clip ? laneName(*clip, shown) : juce::String();
    const bool band = shown.kind == LaneKind::amplitude;
    setTitle(band ? tr("Band at {0}", {name}) : name);
    setDescription(isFrequency(shown.kind)
                       ? "Frequency over time. Double-click to add a point; Delete removes the selection"
                       : "Level over time. Double-click to add a point; Delete removes the selection");
    if (!band)
        return;
    const auto prepare = [this](juce::ToggleButton& button, const juce::String& title, const juce::String& help,
                                std::function<void()> click)
    {
        prepareButton(button, help, std::move(click));
        button.setTitle(tr(title, {getTitle()}));
        addAndMakeVisible(button);
    };
    prepare(pitchButton, "Pitch: {0}", "Shows the pitch of this band (Hz) instead of its level (dB)",
            [this]
            {
                shown.kind = pitchButton.getToggleState() ? LaneKind::pitch : LaneKind::amplitude;
                forgetScale();
                repaint();
            });
    const auto hearing = [this](std::set<std::size_t> Audition::*set, bool on)
    {
        Audition wanted = transport.audition();
        if (on)
            (wanted.*set).insert(shown.index);
        else
            (wanted.*set).erase(shown.index);
        transport.setAudition(std::move(wanted));
    };
    prepare(soloButton, "Solo: {0}", "Plays soloed bands only; the clip is not changed",
            [this, hearing] { hearing(&Audition::solo, soloButton.getToggleState()); });
    prepare(muteButton, "Mute: {0}", "Silences this band; the clip is not changed",
            [this, hearing] { hearing(&Audition::muted, muteButton.getToggleState()); });
    showHearing();
    subscriptions.on({&transport.changed}, [this] { showHearing(); });
}

void CurveLane::resized()
{
    auto area = getLocalBounds().removeFromLeft(laneHeadWidth).withTrimmedRight(6);
    area = area.withSizeKeepingCentre(area.getWidth(), 20);
    muteButton.setBounds(area.removeFromRight(22));
    area.removeFromRight(3);
    soloButton.setBounds(area.removeFromRight(22));
    area.removeFromRight(3);
    pitchButton.setBounds(area.removeFromRight(26));
}

const Curve* CurveLane::curve() const
{
    const auto clip = model.clip();
    return clip ? curveOf(*clip, shown) : nullptr;
}

void CurveLane::showHearing()
{
    const Audition& audition = transport.audition();
    soloButton.setToggleState(audition.solo.contains(shown.index), juce::dontSendNotification);
    muteButton.setToggleState(audition.muted.contains(shown.index), juce::dontSendNotification);
    const bool silent = shown.kind == LaneKind::amplitude && !audition.hears(shown.index);
    if (silent == muted)
        return;
    muted = silent;
    repaint();
}

PlotLane::Style CurveLane::style() const
{
    const auto clip = model.clip();
    if (!clip)
        return {};
    const auto* look = dynamic_cast<const Look*>(&getLookAndFeel());
    const Curve* points = curve();
    Style result{laneName(*clip, shown), counted(points != nullptr ? points->size() : 0, "{0} point", "{0} points"),
                 laneColour(*clip, shown, paletteFor(*this), look == nullptr || look->isDark())};
    if (shown.kind == LaneKind::pitch || shown.kind == LaneKind::amplitude)
        result.note = {};
    if (behind != nullptr && !behind->empty())
        result.behind = tr("Sound");
    return result;
}

ValueAxis CurveLane::valueAxis(double height) const
{
    const auto clip = model.clip();
    if (!isFrequency(shown.kind))
    {
        double highest = 1.0;
        if (!viewState.amplitudesInDecibels() && shown.kind != LaneKind::envelope)
        {
            // Bands are small beside the whole; all have one scale, so that they can be compared.
            highest = 0.05;
            if (clip)
                for (const Band& band : clip->bands)
                    for (const Breakpoint& p : band.amplitude)
                        highest = std::max(highest, p.value);
            ValueAxis axis = amplitudeAxis(false, 1.0, height);
            axis.high = highest;
            return axis;
        }
        if (const Curve* points = curve())
            for (const Breakpoint& p : *points)
                highest = std::max(highest, p.value);
        return amplitudeAxis(viewState.amplitudesInDecibels(), highest, height);
    }
    ValueAxis axis{ValueScale::logarithmic, 20.0, 1500.0, height};
    if (shown.kind == LaneKind::pitch && clip && shown.index < clip->bands.size())
    {
        const Band& band = clip->bands[shown.index];
        axis.low = std::max(1.0, 0.8 * band.lowFrequency);
        axis.high = std::max(1.25 * band.highFrequency, 2.0 * axis.low);
    }
    return axis;
}

bool CurveLane::showsHandles() const
{
    const Curve* points = curve();
    if (points == nullptr)
        return false;
    const auto [first, last] = reaching(*points, viewState.axis().visible(viewState.viewWidth()));
    return static_cast<double>(last - first) * pixelsForHandles <= viewState.viewWidth() + 2.0 * pixelsForHandles;
}

void CurveLane::paintPlot(juce::Graphics& g, juce::Rectangle<int> plot, int firstColumn, int lastColumn)
{
    const Palette& p = paletteFor(*this);
    if (behind != nullptr && !behind->empty())
        paintBehind(g, plot, firstColumn, lastColumn);
    const Curve* points = curve();
    if (points == nullptr || points->empty())
        return;
    const juce::Colour colour = muted ? p.dim.withAlpha(0.5f) : style().colour;
    const bool filled = !isFrequency(shown.kind);
    const TimeAxis& axis = viewState.axis();
    const auto [first, last] =
        reaching(*points, {axis.timeAt(firstColumn - 8.0), axis.timeAt(static_cast<double>(lastColumn) + 8.0)});
    // By the whole view, so that every part of it is drawn alike.
    const double width = viewState.viewWidth();
    const auto [firstSeen, lastSeen] = reaching(*points, axis.visible(width));
    const bool bars = static_cast<double>(lastSeen - firstSeen) > maxPointsPerColumn * width;
    if (bars || filled)
        paintColumns(g, plot, firstColumn, lastColumn, colour, bars);
    drewHandles = !bars && showsHandles();
    if (bars)
        return;
    g.setColour(colour);
    paintLine(g, plot, firstColumn, lastColumn, {first, last});
    if (drewHandles)
        paintHandles(g, {first, last}, colour);
}

/// What the sound has, as a thin line without points; the head says what it is.
void CurveLane::paintBehind(juce::Graphics& g, juce::Rectangle<int> plot, int firstColumn, int lastColumn)
{
    const Palette& p = paletteFor(*this);
    const ValueAxis values = scale();
    const TimeAxis& axis = viewState.axis();
    const auto yOf = [&](double frequency)
    {
        return plot.getY() + juce::roundToInt(std::clamp(values.yOf(frequency), 0.0, values.height));
    };
    ColumnFill line(g, p.dim.withAlpha(0.8f));
    constexpr std::pair none{std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}; // joins nothing
    auto before = none; // top and bottom of the column on the left
    for (int column = firstColumn - 1; column < lastColumn; ++column)
    {
        const auto found = brightnessIn(*behind, axis.timeAt(column), axis.timeAt(column + 1.0));
        if (found.greatest <= 0.0)
        {
            before = none;
            continue;
        }
        const std::pair own(yOf(found.greatest), yOf(found.least));
        // Joined, also where it is steep.
        const int top = std::min(own.first, before.second);
        const int bottom = std::max(own.second, before.first);
        before = own;
        if (column >= firstColumn)
            line.add(plot.getX() + column, top, std::max(1, bottom - top));
    }
}

/// The area under the curve as a bar in each column; with `bars` also the curve, whose points are too many for lines.
void CurveLane::paintColumns(juce::Graphics& g, juce::Rectangle<int> plot, int firstColumn, int lastColumn,
                             juce::Colour colour, bool bars)
{
    const ValueAxis values = scale();
    const bool filled = !isFrequency(shown.kind);
    // Bars of whole pixels are many times faster than filled paths.
    std::vector<Column> columns(static_cast<std::size_t>(std::max(0, lastColumn - firstColumn)));
    TimeAxis axis = viewState.axis();
    axis.start = axis.timeAt(firstColumn);
    curveColumns(*curve(), axis, columns);
    const int bottom = plot.getBottom();
    const juce::Colour fill = colour.withMultipliedAlpha(bars ? 0.35f : 0.18f);
    const auto yOf = [&](float value)
    {
        const double y = std::clamp(values.yOf(static_cast<double>(value)), 0.0, values.height);
        return plot.getY() + juce::roundToInt(y);
    };
    ColumnFill line(g, colour), ground(g, fill); // the line is drawn last
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
        const int x = plot.getX() + firstColumn + static_cast<int>(i);
        const int top = yOf(columns[i].high);
        const int low = bars ? yOf(columns[i].low) : top;
        if (filled)
            ground.add(x, low, bottom - low);
        if (bars)
            line.add(x, top, std::max(2, low - top));
    }
}

/// The curve through the points of `range` in the colour that is set.
void CurveLane::paintLine(juce::Graphics& g, juce::Rectangle<int> plot, int firstColumn, int lastColumn,
                          std::pair<std::size_t, std::size_t> range)
{
    const Curve& points = *curve();
    const ValueAxis values = scale();
    const auto [first, last] = range;
    const auto at = [&](std::size_t i)
    {
        return pointOf(points[i]);
    };
    const auto line = [&](juce::Point<float> from, juce::Point<float> to)
    {
        g.drawLine({from, to}, 1.5f);
    };
    // Before the first and behind the last point their values hold. Line by line, for steep ones make a path slow.
    const float left = static_cast<float>(plot.getX() + firstColumn) - 4.0f;
    const float right = static_cast<float>(plot.getX() + lastColumn) + 4.0f;
    const auto pointAtX = [&](float x)
    {
        const double time = viewState.axis().timeAt(static_cast<double>(x) - plot.getX());
        return juce::Point<float>(x, pointOf({time, valueAt(points, time)}).y);
    };
    if (first == 0 && at(0).x > left)
        line({left, at(0).y}, at(0));
    for (std::size_t i = first; i + 1 < last; ++i)
    {
        const auto from = at(i);
        const auto to = at(i + 1);
        if (values.scale == ValueScale::linear || to.x - from.x <= straightPixels)
        {
            line(from, to);
            continue;
        }
        // What is straight in value bends on a scale of decibels or octaves.
        auto before = from.x >= left ? from : pointAtX(left);
        const float end = std::min(to.x, right);
        while (before.x < end)
        {
            const float x = std::min(end, before.x + straightPixels);
            const auto next = x < to.x ? pointAtX(x) : to;
            line(before, next);
            before = next;
            if (x >= end)
                break;
        }
    }
    if (last == points.size() && at(last - 1).x < right)
        line(at(last - 1), {right, at(last - 1).y});
}

void CurveLane::paintHandles(juce::Graphics& g, std::pair<std::size_t, std::size_t> range, juce::Colour colour)
{
    const Palette& p = paletteFor(*this);
    const Indices chosen = picked();
    for (std::size_t i = range.first; i < range.second; ++i)
    {
        const bool isChosen = std::binary_search(chosen.begin(), chosen.end(), i);
        const float size = isChosen ? 8.0f : 5.0f;
        const auto box = juce::Rectangle<float>(size, size).withCentre(pointOf((*curve())[i]));
        g.setColour(isChosen ? p.text : colour);
        g.fillRect(box);
        if (isChosen)
        {
            g.setColour(p.card);
            g.drawRect(box, 1.0f);
        }
    }
}

std::optional<TimeRange> CurveLane::changedTime(const Clip& before, const Clip& now) const
{
    const Curve* old = curveOf(before, shown);
    const Curve* points = curveOf(now, shown);
    // Names and colours of bands follow from all of them.
    if (old == nullptr || points == nullptr || before.bands.size() != now.bands.size() ||
        laneName(before, shown) != laneName(now, shown) || showsHandles() != drewHandles)
        return std::nullopt;
    return PlotLane::changedTime(*old, *points);
}

std::optional<std::size_t> CurveLane::thingAt(juce::Point<float> place) const
{
    const Curve* points = curve();
    if (points == nullptr || !showsHandles())
        return std::nullopt;
    const auto plot = plotArea();
    return pointAt(*points, viewState.axis(), scale(), static_cast<double>(place.x) - plot.getX(),
                   static_cast<double>(place.y) - plot.getY(), static_cast<double>(pickRadius));
}

std::size_t CurveLane::count() const
{
    const Curve* points = curve();
    return points != nullptr ? points->size() : 0;
}

Breakpoint CurveLane::place(std::size_t thing) const
{
    return (*curve())[thing];
}

Selection CurveLane::pick(Selection selection, Indices things) const
{
    return withPoints(std::move(selection), shown, std::move(things));
}

void CurveLane::addInside(Selection& selection, juce::Rectangle<float> area) const
{
    const Curve* points = curve();
    const auto plot = plotArea().toFloat();
    if (points == nullptr || !area.intersects(plot))
        return;
    const ValueAxis values = scale();
    const auto valueAt = [&](float y)
    {
        return values.valueAtY(static_cast<double>(y - plot.getY()));
    };
    const TimeRange times{viewState.axis().timeAt(static_cast<double>(area.getX() - plot.getX())),
                          viewState.axis().timeAt(static_cast<double>(area.getRight() - plot.getX()))};
    // Over the edge of the lane means all that lies beyond it.
    const ValueRange range{area.getBottom() >= plot.getBottom() - 1.0f ? -1.0 : valueAt(area.getBottom()),
                           area.getY() <= plot.getY() + 1.0f ? limits::frequency : valueAt(area.getY())};
    const Indices inside = pointsInside(*points, times, range);
    selection = withPoints(selection, shown, unionOf(selectedIn(selection, shown), inside));
}

EditedClip CurveLane::added(const Clip& clip, Breakpoint where) const
{
    EditedClip result{clip, {}};
    if (Curve* points = curveOf(result.clip, shown))
    {
        EditedCurve edited = addPoint(*points, where, limitsOf(clip, shown));
        *points = std::move(edited.curve);
        result.selection = withPoints({}, shown, std::move(edited.selection));
    }
    return result;
}

SelectionMove CurveLane::move(Breakpoint from, Breakpoint to) const
{
    SelectionMove result;
    if (isFrequency(shown.kind))
        result.frequencyFactor = from.value > 0.0 ? to.value / from.value : 1.0;
    else
        result = amplitudeMove(from.value, to.value);
    return result;
}

juce::String CurveLane::valueText(double value) const
{
    return isFrequency(shown.kind) ? hertzText(value) : amplitudeText(value);
}

// Drawing and bending.

template <typename Edit>
void CurveLane::change(const char* name, Edit edit)
{
    const auto start = gestureStart(model, toolGesture);
    const Curve* before = start ? curveOf(*start, shown) : nullptr;
    if (before == nullptr)
        return;
    EditedCurve edited = edit(*before, limitsOf(*start, shown));
    EditedClip result{*start, withPoints({}, shown, std::move(edited.selection))};
    *curveOf(result.clip, shown) = std::move(edited.curve);
    clipSelection.setEdited(name, std::move(result), toolGesture);
}

std::optional<std::size_t> CurveLane::lineAt(juce::Point<float> place) const
{
    const auto clip = model.clip();
    const Curve* points = clip ? curveOf(*clip, shown) : nullptr;
    const auto plot = plotArea();
    if (points == nullptr || points->size() < 2 || !showsHandles() || !plot.toFloat().contains(place))
        return std::nullopt;
    const double x = static_cast<double>(place.x) - plot.getX();
    const double y = static_cast<double>(place.y) - plot.getY();
    const double time = viewState.axis().timeAt(x);
    if (time < points->front().time || time >= points->back().time ||
        !lineIsAt(*points, viewState.axis(), scale(), x, y, lineReach))
        return std::nullopt;
    const auto next = std::upper_bound(points->begin(), points->end(), time,
                                       [](double t, const Breakpoint& p) { return t < p.time; });
    return static_cast<std::size_t>(next - points->begin()) - 1;
}

juce::MouseCursor CurveLane::cursorAt(const juce::MouseEvent& event) const
{
    if (viewState.isDrawing())
        return juce::MouseCursor::CrosshairCursor;
    if (event.mods.isCommandDown() && lineAt(event.position))
        return juce::MouseCursor::UpDownResizeCursor;
    return juce::MouseCursor::NormalCursor;
}

bool CurveLane::beginTool(const juce::MouseEvent& event)
{
    bent.reset();
    if (viewState.isDrawing())
    {
        toolGesture = model.beginGesture();
        const auto place = event.position - plotArea().getPosition().toFloat();
        stroke.begin(static_cast<double>(place.x), static_cast<double>(place.y));
        draw(place);
        return true;
    }
    const auto line = event.mods.isCommandDown() && !thingAt(event.position) ? lineAt(event.position) : std::nullopt;
    if (!line)
        return false;
    toolGesture = model.beginGesture();
    bent = Bend{*line, placeAt(event.position).time};
    return true;
}

void CurveLane::dragTool(const juce::MouseEvent& event)
{
    if (!bent)
        return draw(event.position - plotArea().getPosition().toFloat());
    const auto offset = static_cast<double>(event.getOffsetFromDragStart().y);
    change("Bend line", [&](const Curve& curve, const CurveLimits& limits)
           { return bentLine(curve, bent->first, bent->time, offset, viewState.axis(), scale(), limits); });
    say(valueText(placeAt(event.position).value));
}

void CurveLane::draw(juce::Point<float> to)
{
    stroke.to(static_cast<double>(to.x), static_cast<double>(to.y));
    change("Draw", [&](const Curve& curve, const CurveLimits& limits)
           { return withDrawn(curve, pointsOf(stroke, viewState.axis(), scale(), limits), limits); });
}

} // namespace pacini::editor
