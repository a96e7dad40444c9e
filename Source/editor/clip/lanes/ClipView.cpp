// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/ClipView.h"

#include "editor/Controls.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/lanes/CurveLane.h"
#include "editor/clip/lanes/EventLane.h"
#include "editor/clip/lanes/LaneText.h"

#include <algorithm>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr int rulerHeight = 26;
constexpr int waveformHeight = 72;
constexpr int spectrumHeight = 112;
constexpr float wheelForHeight = 0.1f; // of a trackpad; a notch of a wheel is more
constexpr int overviewHeight = 40;
constexpr int scrollBarWidth = 10;
constexpr int headHeight = 8; // of the playhead
} // namespace

/// Playhead and marquee on top of all lanes; ignores the mouse.
class ClipView::Overlay final : public juce::Component
{
public:
    Overlay(const EditorModel& project, const ViewState& sight) : model(project), viewState(sight)
    {
        setInterceptsMouseClicks(false, false);
        setAccessible(false);
    }

    void setPlayhead(int x)
    {
        if (x == playhead)
            return;
        repaint(strip());
        playhead = x;
        repaint(strip());
    }

    void setMarquee(std::optional<juce::Rectangle<int>> wanted)
    {
        if (marquee)
            repaint(marquee->expanded(2));
        marquee = wanted;
        if (marquee)
            repaint(marquee->expanded(2));
    }

    void paint(juce::Graphics& g) override
    {
        const Palette& p = paletteFor(*this);
        paintMarkers(g, p);
        paintVersion(g, p);
        if (playhead >= laneHeadWidth)
        {
            g.setColour(p.text);
            g.fillRect(playhead, 0, 1, getHeight());
            juce::Path head;
            const auto x = static_cast<float>(playhead) + 0.5f;
            head.addTriangle(x - 5.0f, 0.0f, x + 5.0f, 0.0f, x, static_cast<float>(headHeight));
            g.fillPath(head);
        }
        if (marquee)
        {
            g.setColour(p.accent.withAlpha(0.15f));
            g.fillRect(*marquee);
            g.setColour(p.accent);
            g.drawRect(*marquee, 1);
        }
    }

private:
    /// Lines through all lanes, below the flags.
    void paintMarkers(juce::Graphics& g, const Palette& p) const
    {
        const auto clip = model.clip();
        if (!clip)
            return;
        g.setColour(p.accent.withAlpha(0.55f));
        for (const Marker& marker : clip->markers)
        {
            const double x = viewState.axis().xOf(marker.time);
            if (x >= 0.0 && x <= viewState.viewWidth())
                g.fillRect(laneHeadWidth + juce::roundToInt(x), rulerHeight + MarkerStrip::height, 1, getHeight());
        }
    }

    void paintVersion(juce::Graphics& g, const Palette& p) const
    {
        if (!model.isComparing())
            return;
        const auto place = getLocalBounds()
                               .withTrimmedLeft(laneHeadWidth)
                               .withTop(rulerHeight + MarkerStrip::height + grid)
                               .withHeight(3 * grid)
                               .withSizeKeepingCentre(34 * grid, 3 * grid);
        g.setColour(p.accent);
        g.fillRoundedRectangle(place.toFloat(), 4.0f);
        g.setColour(p.background);
        g.setFont(usualFont());
        g.drawFittedText(tr("Version A, for comparison. Press C to return."), place.reduced(grid, 0),
                         juce::Justification::centred, 1);
    }

    const EditorModel& model;
    const ViewState& viewState;

    [[nodiscard]] juce::Rectangle<int> strip() const { return {playhead - 6, 0, 13, getHeight()}; }

    int playhead = -100;
    std::optional<juce::Rectangle<int>> marquee;
};

ClipView::ClipView(Session& shared)
    : model(shared.model),
      clipSelection(shared.clipSelection),
      viewState(shared.viewState),
      transport(shared.transport),
      ruler(model, clipSelection, viewState, transport),
      tools(model, viewState),
      selectionBar(model, clipSelection, viewState, transport),
      markers(model, viewState, transport),
      waveform(model, shared.sounds, viewState),
      actuator(model, shared.actuators, viewState),
      overview(model, viewState),
      overlay(std::make_unique<Overlay>(model, viewState))
{
    setTitle("Clip");
    setFocusContainerType(FocusContainerType::focusContainer);
    viewport.setViewedComponent(&rows, false);
    viewport.setScrollBarsShown(true, false);
    viewport.setScrollBarThickness(scrollBarWidth);
    viewport.setWantsKeyboardFocus(false);
    addAll(*this, {&ruler, &tools, &selectionBar, &waveform, &viewport, &actuator, &overview});
    addChildComponent(markers);
    addAndMakeVisible(*overlay);
    markers.onCommand = [this](Command command)
    {
        if (onCommand)
            onCommand(command);
    };
    subscriptions.on({&model.contentChanged, &viewState.lookChanged}, [this] { rebuild(); });
    subscriptions.on({&model.contentChanged, &shared.actuators.changed},
                     [this]
                     {
                         if (showMarkers() || (actuator.isVisible() && actuator.getHeight() != actuator.wantedHeight()))
                             resized();
                     });
    brightness.onChanged = [this]
    {
        if (auto* row = rowOf({LaneKind::centroid, 0}))
            row->repaint();
    };
    const auto showBrightness = [this, &sounds = shared.sounds]
    {
        const auto item = model.shownItem();
        brightness.show(item ? sounds.soundOfClip() : nullptr, item ? item->encoder.lowFrequency : 0.0,
                        item ? item->encoder.highFrequency : 0.0);
    };
    subscriptions.on({&model.contentChanged, &shared.sounds.changed}, showBrightness);
    showBrightness();
    subscriptions.on({&viewState.lookChanged}, [this] { resized(); });
    subscriptions.on({&viewState.axisChanged, &transport.changed, &model.contentChanged}, [this] { placePlayhead(); });
    rebuild();
    startTimerHz(60);
}

ClipView::~ClipView() = default;

juce::Rectangle<int> ClipView::plotArea() const
{
    return getLocalBounds().withTrimmedLeft(laneHeadWidth).withTrimmedRight(scrollBarWidth);
}

/// Whether that has changed.
bool ClipView::showMarkers()
{
    const auto clip = model.clip();
    const bool any = clip && !clip->markers.empty();
    const bool others = any != markers.isVisible();
    markers.setVisible(any);
    return others;
}

void ClipView::rebuild()
{
    std::vector<Lane> wanted;
    if (const auto clip = model.clip())
    {
        wanted = {{LaneKind::envelope, 0}, {LaneKind::centroid, 0}};
        for (std::size_t k = clip->bands.size(); k-- > 0;)
            wanted.push_back({LaneKind::amplitude, k});
        for (std::size_t k = 0; k < clip->noise.size(); ++k)
            wanted.push_back({LaneKind::noise, k});
        // Bands of one number can have other frequencies.
        for (std::size_t k = 0; k < clip->bands.size(); ++k)
            if (auto* row = rowOf({LaneKind::amplitude, k}))
                row->setTitle(tr("Band at {0}", {laneName(*clip, {LaneKind::amplitude, k})}));
        for (std::size_t k = 0; k < clip->noise.size(); ++k)
            if (auto* row = rowOf({LaneKind::noise, k}))
                row->setTitle(laneName(*clip, {LaneKind::noise, k}));
    }
    if (wanted != built)
    {
        lanes.clear();
        built = wanted;
        const auto add = [this](std::unique_ptr<PlotLane> lane)
        {
            lane->onMarquee = [this](PlotLane& from, const juce::MouseEvent& event, bool over)
            {
                marquee(from, event, over);
            };
            translateTexts(*lane); // made after those of the window were
            rows.addAndMakeVisible(*lane);
            lanes.push_back(std::move(lane));
        };
        if (!wanted.empty())
        {
            add(std::make_unique<EventLane>(model, clipSelection, viewState, transport, EventLane::Shows::amplitude));
            add(std::make_unique<EventLane>(model, clipSelection, viewState, transport, EventLane::Shows::sharpness));
        }
        for (const Lane& lane : wanted)
        {
            auto curve = std::make_unique<CurveLane>(model, clipSelection, viewState, transport, lane);
            if (lane.kind == LaneKind::centroid)
                curve->setBehind(&brightness.curve());
            add(std::move(curve));
        }
    }
    layOut();
}

PlotLane* ClipView::rowOf(Lane lane) const
{
    for (const auto& row : lanes)
        if (const auto* curve = dynamic_cast<const CurveLane*>(row.get());
            curve != nullptr && curve->lane().index == lane.index &&
            (curve->lane().kind == lane.kind ||
             (curve->lane().kind == LaneKind::pitch && lane.kind == LaneKind::amplitude)))
            return row.get();
    return nullptr;
}

PlotLane* ClipView::eventRow() const
{
    return lanes.empty() ? nullptr : lanes.front().get();
}

void ClipView::paint(juce::Graphics& g)
{
    g.fillAll(paletteFor(*this).background);
}

void ClipView::resized()
{
    auto area = getLocalBounds();
    overlay->setBounds(area.withTrimmedRight(scrollBarWidth).withTrimmedBottom(overviewHeight));
    ruler.setBounds(area.removeFromTop(rulerHeight).withTrimmedRight(scrollBarWidth));
    tools.setBounds(ruler.getBounds().withWidth(laneHeadWidth));
    selectionBar.setBounds(ruler.getBounds().withTrimmedLeft(laneHeadWidth).withHeight(SelectionBar::height));
    if (markers.isVisible())
        markers.setBounds(area.removeFromTop(MarkerStrip::height).withTrimmedRight(scrollBarWidth));
    const bool tall = viewState.viewOptions().sound != SoundView::waveform;
    waveform.setBounds(area.removeFromTop(tall ? spectrumHeight : waveformHeight).withTrimmedRight(scrollBarWidth));
    overview.setBounds(area.removeFromBottom(overviewHeight).withTrimmedRight(scrollBarWidth));
    actuator.setVisible(viewState.viewOptions().actuator);
    if (actuator.isVisible())
        actuator.setBounds(area.removeFromBottom(actuator.wantedHeight()).withTrimmedRight(scrollBarWidth));
    viewport.setBounds(area);
    viewState.setViewWidth(plotArea().getWidth());
    layOut();
    placePlayhead();
}

void ClipView::layOut()
{
    const int width = getWidth() - scrollBarWidth;
    // In halves of a band's height.
    const auto halvesOf = [this](std::size_t i)
    {
        const auto* curve = dynamic_cast<const CurveLane*>(lanes[i].get());
        const bool low =
            curve != nullptr && curve->lane().kind != LaneKind::envelope && curve->lane().kind != LaneKind::centroid;
        return i == 1 || low ? 2 : 3;
    };
    int halves = 0;
    for (std::size_t i = 0; i < lanes.size(); ++i)
        halves += halvesOf(i);
    // Lanes grow until no room is left below them.
    const int total = std::max(halves * viewState.laneHeight() / 2, lanes.empty() ? 0 : viewport.getHeight());
    shownUnit = halves > 0 ? 2 * total / halves : viewState.laneHeight();
    int y = 0, before = 0;
    for (std::size_t i = 0; i < lanes.size(); ++i)
    {
        before += halvesOf(i);
        const int bottom = total * before / halves;
        lanes[i]->setBounds(0, y, width, bottom - y);
        y = bottom;
    }
    rows.setSize(width, y);
}

void ClipView::placePlayhead()
{
    if (!model.clip())
        return overlay->setPlayhead(-100);
    const double time = transport.playhead();
    if (transport.isPlaying() && !isMouseButtonDownAnywhere())
        viewState.setAxis(followed(viewState.axis(), time, viewState.viewWidth(), viewState.viewOptions().followNow()));
    const double x = viewState.axis().xOf(time);
    overlay->setPlayhead(x < 0.0 || x > viewState.viewWidth() ? -100 : laneHeadWidth + juce::roundToInt(x));
}

void ClipView::zoomAtPlayhead(double factor)
{
    const double x = viewState.axis().xOf(transport.playhead());
    viewState.zoom(factor, x >= 0.0 && x <= viewState.viewWidth() ? x : 0.5 * viewState.viewWidth());
}

void ClipView::mouseMagnify(const juce::MouseEvent& event, float factor)
{
    const auto here = event.getEventRelativeTo(this);
    viewState.zoom(static_cast<double>(factor), static_cast<double>(here.position.x) - laneHeadWidth);
}

void ClipView::mouseWheelMove(const juce::MouseEvent& event, const juce::MouseWheelDetails& details)
{
    const auto here = event.getEventRelativeTo(this);
    const double x = static_cast<double>(here.position.x) - laneHeadWidth;
    if (event.mods.isAltDown())
    {
        // Trackpads send many small steps.
        heightWheel += details.deltaY;
        if (std::abs(heightWheel) < wheelForHeight)
            return;
        viewState.setLaneHeight(heightWheel > 0.0f ? shownUnit + 8 : viewState.laneHeight() - 8);
        heightWheel = 0.0f;
        return;
    }
    const bool sideways = event.mods.isShiftDown() || std::abs(details.deltaX) > std::abs(details.deltaY);
    if (!sideways && details.isInertial)
        return; // a trackpad that runs on would zoom away
    if (!sideways)
        return viewState.zoom(std::exp2(4.0 * static_cast<double>(details.deltaY)), std::max(0.0, x));
    const float delta = std::abs(details.deltaX) > std::abs(details.deltaY) ? details.deltaX : details.deltaY;
    TimeAxis axis = viewState.axis();
    axis.start -= static_cast<double>(delta) * viewState.viewWidth() * axis.secondsPerPixel;
    viewState.setAxis(axis);
}

void ClipView::marquee(PlotLane& from, const juce::MouseEvent& event, bool over)
{
    const auto here = event.getEventRelativeTo(this);
    const auto start = here.getMouseDownPosition();
    if (!event.mouseWasDraggedSinceMouseDown())
    {
        if (!over)
        {
            beforeMarquee = event.mods.isShiftDown() ? clipSelection.selected() : Selection{};
            clipSelection.select(beforeMarquee);
        }
        else if (!event.mods.isPopupMenu())
            transport.setPlayhead(viewState.axis().timeAt(static_cast<double>(here.position.x) - laneHeadWidth));
        return;
    }
    juce::ignoreUnused(from);
    const auto area = juce::Rectangle<int>(start, here.getPosition()).getIntersection(plotArea());
    overlay->setMarquee(over ? std::nullopt : std::optional(area));
    Selection now = beforeMarquee;
    for (const auto& lane : lanes)
        lane->addInside(now, lane->getLocalArea(this, area).toFloat());
    clipSelection.select(std::move(now));
}

} // namespace pacini::editor
