// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/ActuatorRow.h"

#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/lanes/LaneText.h"
#include "editor/clip/lanes/PlotLane.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr int lossHeight = 50;
constexpr int emptyHeight = 34;
constexpr int restMilliseconds = 300; // of the clip, before it is rendered
constexpr double inaudible = -100.0;  // dB

juce::String share(std::span<const Loss> losses, Loss wanted, const char* name)
{
    const auto count = static_cast<double>(std::count(losses.begin(), losses.end(), wanted));
    const double percent = losses.empty() ? 0.0 : 100.0 * count / static_cast<double>(losses.size());
    if (percent <= 0.0)
        return {};
    return tr(name) + " " + (percent < 1.0 ? juce::String("< 1") : juce::String(juce::roundToInt(percent))) + " %";
}
} // namespace

ActuatorRow::ActuatorRow(const EditorModel& project, const Actuators& profiles, const ViewState& sight)
    : model(project), actuators(profiles), viewState(sight)
{
    setOpaque(true);
    setTitle("What the actuator plays");
    subscriptions.on({&model.contentChanged, &actuators.changed, &viewState.lookChanged}, [this] { update(); });
    subscriptions.on({&viewState.axisChanged}, [this] { repaint(getLocalBounds().withTrimmedLeft(laneHeadWidth)); });
    update();
}

ActuatorRow::~ActuatorRow()
{
    if (cancelled)
        cancelled->store(true);
}

int ActuatorRow::wantedHeight() const
{
    return actuators.profile() ? driveHeight + lossHeight : emptyHeight;
}

juce::Rectangle<int> ActuatorRow::drivePlot() const
{
    return getLocalBounds().withTrimmedLeft(laneHeadWidth).withHeight(driveHeight).withTrimmedBottom(1);
}

juce::Rectangle<int> ActuatorRow::lossPlot() const
{
    return getLocalBounds().withTrimmedLeft(laneHeadWidth).withTrimmedTop(driveHeight).withTrimmedBottom(1);
}

void ActuatorRow::update()
{
    const auto clip = model.clip();
    const auto profile = actuators.profile();
    const bool wanted = clip && profile && viewState.viewOptions().actuator;
    const bool same = profile ? askedProfile && *profile == *askedProfile : !askedProfile;
    if (clip == askedClip && same && (wanted || !clip || !profile))
        return;
    if (!wanted)
    {
        const bool changedActuator = profile.operator bool() == !askedProfile;
        stopTimer();
        if (cancelled)
            cancelled->store(true);
        askedClip = clip;
        askedProfile.reset();
        if (profile && clip)
            askedClip.reset(); // hidden: asked again when it is shown
        waiting = false;
        if (shown || changedActuator)
            show(nullptr);
        return;
    }
    // Of another clip nothing is to be seen; of an edited one the old until the new is there.
    if (shown && !same)
        show(nullptr);
    waiting = true;
    startTimer(restMilliseconds);
    repaint(getLocalBounds().withWidth(laneHeadWidth));
}

void ActuatorRow::timerCallback()
{
    stopTimer();
    askedClip = model.clip();
    const auto profile = actuators.profile();
    if (!askedClip || !profile)
        return;
    askedProfile = *profile;
    if (cancelled)
        cancelled->store(true);
    cancelled = std::make_shared<std::atomic<bool>>(false);
    jobs.run([clip = askedClip, profile, stop = cancelled] { return traceActuator(*clip, *profile, *stop); },
             [this, stop = cancelled](Result<std::shared_ptr<const ActuatorTrace>> made)
             {
                 if (stop != cancelled || stop->load())
                     return;
                 waiting = false;
                 failure = made ? juce::String() : toText(made.error().text());
                 show(made ? *made : nullptr);
             });
}

void ActuatorRow::show(std::shared_ptr<const ActuatorTrace> wanted)
{
    shown = std::move(wanted);
    lossStale = true;
    summary = {};
    juce::String told;
    if (shown)
    {
        const juce::String limited = share(shown->losses, Loss::limited, "limited");
        const juce::String soft = share(shown->losses, Loss::belowTouch, "not felt");
        summary = limited + (limited.isNotEmpty() && soft.isNotEmpty() ? ", " : "") + soft;
        for (const auto& change : shown->changes)
            told << (told.isEmpty() ? "" : "; ") << toText(change);
    }
    setDescription(told.isEmpty() ? juce::String("The drive of the actuator in dB of full drive, and what is lost")
                                  : "Fitted to the actuator: " + told);
    setTooltip(getDescription());
    repaint();
}

std::size_t ActuatorRow::sourceAt(double y) const
{
    // High bands above, noise at the foot, as the lanes.
    const std::size_t count = shown->sources.size();
    const auto bands = static_cast<std::size_t>(std::count_if(shown->sources.begin(), shown->sources.end(),
                                                              [](const auto& source)
                                                              { return source.lane.kind == LaneKind::amplitude; }));
    const double place = std::clamp(y / std::max(1, lossPlot().getHeight()), 0.0, 0.999999);
    const auto row = static_cast<std::size_t>(place * static_cast<double>(count));
    return row < bands ? bands - 1 - row : row;
}

juce::String ActuatorRow::textAt(juce::Point<float> place) const
{
    const auto clip = model.clip();
    if (!shown || !clip || place.x < static_cast<float>(laneHeadWidth))
        return getDescription();
    const double time = viewState.axis().timeAt(static_cast<double>(place.x) - laneHeadWidth);
    const auto step = shown->stepAt(time);
    if (!step)
        return getDescription();
    juce::String text = juce::String(time, 3) + " s, ";
    if (lossPlot().contains(place.toInt()) && !shown->sources.empty())
    {
        const auto& source = shown->sources[sourceAt(static_cast<double>(place.y) - lossPlot().getY())];
        text << laneName(*clip, source.lane) << ": ";
        const auto why = toText(shown->textOf(source, *step));
        if (why.isNotEmpty())
            return text + why;
        if (source.levels[*step] <= ActuatorTrace::silent)
            return text + "silent";
        return text + "played at " + hertzText(static_cast<double>(source.played[*step])) + ", " +
               juce::String(juce::roundToInt(source.levels[*step])) + " dB";
    }
    const double level = 20.0 * std::log10(std::max(1e-6, static_cast<double>(shown->peaks[*step])));
    text << (level <= inaudible ? juce::String("silent") : juce::String(level, 1) + " dB of full drive");
    const auto why = toText(shown->textOf(*step));
    if (why.isNotEmpty())
        return text + ", " + why;
    if (level > shown->touch)
        text << ", " << juce::roundToInt(level - shown->touch) << " dB above touch";
    return text;
}

void ActuatorRow::mouseMove(const juce::MouseEvent& event)
{
    setTooltip(textAt(event.position));
}

} // namespace pacini::editor
