// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/ActuatorRow.h"

#include "editor/ActuatorItem.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/lanes/ColumnFill.h"
#include "editor/clip/lanes/LaneText.h"
#include "editor/clip/lanes/PlotLane.h"

#include <pacini/foundation/Units.h>

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
    return tr(name, {percent < 1.0 ? juce::String("< 1") : juce::String(juce::roundToInt(percent))});
}

constexpr double roomBelowTouch = 12.0;  // dB
constexpr std::size_t stepsPerPixel = 8; // are looked at, at most
constexpr int shades = 8;

juce::Colour lossColour(Loss loss, const Palette& p)
{
    switch (loss)
    {
    case Loss::belowTouch:
        return p.dim.interpolatedWith(p.well, 0.45f);
    case Loss::outOfRange:
        return p.warning;
    case Loss::noVoice:
        return p.tone;
    case Loss::dropped:
    case Loss::limited:
        return p.danger;
    case Loss::none:
        break;
    }
    return p.well;
}

bool darkOf(const juce::Component& component)
{
    const auto* look = dynamic_cast<const Look*>(&component.getLookAndFeel());
    return look == nullptr || look->isDark();
}

/// What a pixel of a source shows: what takes most of it, or, where nothing does, how loud it plays.
struct LossShade
{
    Loss loss = Loss::none;
    int step = 0; ///< of `shades`
};

/// None where the source plays nothing from `start` to `end`, s; `touch` is the threshold, dB.
std::optional<LossShade> shadeOf(const ActuatorTrace::Source& source, double start, double end, double touch)
{
    const double from = start / ActuatorTrace::step;
    const double to = std::max(from + 1.0, end / ActuatorTrace::step);
    const auto steps = static_cast<double>(source.levels.size());
    if (from < 0.0 || from >= steps)
        return std::nullopt;
    const auto first = static_cast<std::size_t>(from);
    const auto last = static_cast<std::size_t>(std::min(to, steps));
    const std::size_t stride = std::max<std::size_t>(1, (last - first) / stepsPerPixel);
    std::array<int, 6> votes{};
    float most = ActuatorTrace::silent;
    int silent = 0;
    for (std::size_t i = first; i < last; i += stride)
    {
        const Loss loss = source.losses[i];
        if (loss == Loss::none && source.levels[i] <= ActuatorTrace::silent)
            ++silent;
        else
            ++votes[static_cast<std::size_t>(loss)];
        most = std::max(most, source.levels[i]);
    }
    const auto winner = std::max_element(votes.begin(), votes.end());
    if (*winner == 0 || *winner < silent)
        return std::nullopt;
    const double part = std::clamp(1.0 - static_cast<double>(most) / touch, 0.0, 1.0);
    return LossShade{static_cast<Loss>(winner - votes.begin()), static_cast<int>(std::lround(part * (shades - 1)))};
}
} // namespace

ActuatorRow::ActuatorRow(const EditorModel& project, const Actuators& profiles, const ViewState& sight)
    : model(project), actuators(profiles), viewState(sight)
{
    setOpaque(true);
    setTitle("Actuator output");
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
    if (clip == askedClip && same && actuators.strength() == askedStrength && (wanted || !clip || !profile))
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
    // Of another clip nothing is to be seen; of an edited one, or with another strength, the old until the new is
    // there.
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
    askedStrength = actuators.strength();
    if (cancelled)
        cancelled->store(true);
    cancelled = std::make_shared<std::atomic<bool>>(false);
    jobs.run([clip = askedClip, profile, strength = askedStrength, stop = cancelled]
             { return traceActuator(*clip, *profile, strength, *stop); },
             [this, stop = cancelled](Result<std::shared_ptr<const ActuatorTrace>> made)
             {
                 if (stop != cancelled || stop->load())
                     return;
                 waiting = false;
                 failure = made ? juce::String() : translateMessage(toText(made.error().text()));
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
        const juce::String limited = share(shown->losses, Loss::limited, "limited {0} %");
        const juce::String soft = share(shown->losses, Loss::belowTouch, "not felt {0} %");
        summary = limited + (limited.isNotEmpty() && soft.isNotEmpty() ? ", " : "") + soft;
        for (const auto& change : shown->changes)
            told << (told.isEmpty() ? "" : "; ") << translateMessage(toText(change));
    }
    setDescription(told.isEmpty() ? tr("Actuator drive in dB re full drive, and losses")
                                  : tr("Adapted to the actuator: {0}", {told}));
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
    juce::String text = numberText(time, 3) + " s, ";
    if (lossPlot().contains(place.toInt()) && !shown->sources.empty())
    {
        const auto& source = shown->sources[sourceAt(static_cast<double>(place.y) - lossPlot().getY())];
        text << laneName(*clip, source.lane) << ": ";
        const auto why = translateMessage(toText(shown->textOf(source, *step)));
        if (why.isNotEmpty())
            return text + why;
        if (source.levels[*step] <= ActuatorTrace::silent)
            return text + tr("silent");
        return text + tr("played at {0}, {1} dB", {hertzText(static_cast<double>(source.played[*step])),
                                                   juce::String(juce::roundToInt(source.levels[*step]))});
    }
    const double level = Decibels::fromGain(std::max(1e-6, static_cast<double>(shown->peaks[*step]))).value;
    text << (level <= inaudible ? tr("silent") : tr("{0} dB re full drive", {numberText(level, 1)}));
    const auto why = translateMessage(toText(shown->textOf(*step)));
    if (why.isNotEmpty())
        return text + ", " + why;
    if (level > shown->touch)
        text << ", " << tr("{0} dB above threshold", {juce::String(juce::roundToInt(level - shown->touch))});
    return text;
}

void ActuatorRow::mouseMove(const juce::MouseEvent& event)
{
    setTooltip(textAt(event.position));
}

// Painting.

void ActuatorRow::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.card);
    if (g.getClipBounds().getX() < laneHeadWidth)
        paintHead(g);
    g.setColour(p.line);
    g.fillRect(getLocalBounds().removeFromTop(1));
    const auto plot = getLocalBounds().withTrimmedLeft(laneHeadWidth).withTrimmedTop(1);
    const juce::Graphics::ScopedSaveState saved(g);
    if (!g.reduceClipRegion(plot))
        return;
    g.setColour(p.well);
    g.fillRect(plot);
    if (!shown)
    {
        const bool chosen = actuators.profile() != nullptr;
        g.setColour(failure.isNotEmpty() && chosen ? p.warning : p.dim);
        g.setFont(smallFont());
        g.drawFittedText(!chosen
                             ? tr("No actuator chosen. Choose one at the top right to see its signal and the losses.")
                         : failure.isNotEmpty() ? failure
                                                : tr(toText("Rendering…")),
                         plot.reduced(grid, 2), juce::Justification::centredLeft, 2);
        return;
    }
    paintDrive(g, drivePlot().withTrimmedTop(1));
    g.setColour(p.line);
    g.fillRect(plot.getX(), driveHeight - 1, plot.getWidth(), 1);
    paintLosses(g, lossPlot());
}

void ActuatorRow::paintHead(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    auto head = getLocalBounds().withWidth(laneHeadWidth);
    g.setColour(p.accent);
    g.fillRect(head.removeFromLeft(3));
    head = head.withTrimmedLeft(grid).withTrimmedRight(4);
    const auto profile = actuators.profile();
    auto top = profile ? head.removeFromTop(driveHeight) : head;
    const bool third = profile != nullptr;
    top = top.withSizeKeepingCentre(top.getWidth(), third ? 50 : 19);
    g.setColour(p.text);
    g.setFont(usualFont());
    g.drawFittedText(tr("Actuator"), top.removeFromTop(19), juce::Justification::centredLeft, 1);
    if (!profile)
        return;
    g.setColour(p.dim);
    g.setFont(smallFont());
    g.drawFittedText(actuatorText(*profile), top.removeFromTop(15), juce::Justification::centredLeft, 1);
    g.drawFittedText(waiting ? tr(toText("Rendering…")) : summary, top.removeFromTop(15),
                     juce::Justification::centredLeft, 1);
    // What the colours of the lower plot mean.
    struct Item
    {
        Loss loss;
        const char* name;
    };
    auto legend = head.withSizeKeepingCentre(head.getWidth(), 44);
    for (const Item& item :
         {Item{Loss::belowTouch, "not felt"}, Item{Loss::outOfRange, "out of range"}, Item{Loss::noVoice, "merged"}})
    {
        auto line = legend.removeFromTop(14);
        const auto swatch = [&](Loss loss)
        {
            g.setColour(lossColour(loss, p));
            g.fillRect(line.removeFromLeft(9).withSizeKeepingCentre(9, 9));
            line.removeFromLeft(4);
            g.setColour(p.dim);
        };
        auto second = line;
        swatch(item.loss);
        g.drawFittedText(tr(item.name), line.withWidth(72), juce::Justification::centredLeft, 1);
        if (item.loss == Loss::belowTouch)
        {
            line = second.withTrimmedLeft(74);
            swatch(Loss::dropped);
            g.drawFittedText(tr("left out"), line, juce::Justification::centredLeft, 1);
        }
    }
}

void ActuatorRow::paintDrive(juce::Graphics& g, juce::Rectangle<int> plot)
{
    const Palette& p = paletteFor(*this);
    const auto visible = g.getClipBounds().getIntersection(plot);
    if (visible.isEmpty())
        return;
    const double lowest = shown->touch - roomBelowTouch;
    const auto yOf = [&](double decibels)
    {
        return plot.getY() + juce::roundToInt(plot.getHeight() * std::clamp(decibels / lowest, 0.0, 1.0));
    };
    const int touch = yOf(shown->touch);
    g.setColour(p.dim.withAlpha(0.12f));
    g.fillRect(plot.withTop(touch));
    TimeAxis axis = viewState.axis();
    axis.start = axis.timeAt(visible.getX() - plot.getX());
    std::vector<Column> peaks(static_cast<std::size_t>(visible.getWidth())), taken(peaks.size());
    shown->drive.columns(axis, peaks);
    shown->reduction.columns(axis, taken);
    const juce::Colour limited = lossColour(Loss::limited, p);
    const juce::Colour soft = lossColour(Loss::belowTouch, p);
    {
        ColumnFill limits(g, limited), softLine(g, p.dim), line(g, p.accent), softGround(g, soft),
            ground(g, p.accent.withAlpha(0.45f)); // drawn from the last to the first
        for (std::size_t i = 0; i < peaks.size(); ++i)
        {
            const int x = visible.getX() + static_cast<int>(i);
            if (peaks[i].high > 0.0f)
            {
                const double level = Decibels::fromGain(static_cast<double>(peaks[i].high)).value;
                const int y = yOf(level);
                const bool isSoft = level < shown->touch;
                (isSoft ? softGround : ground).add(x, y, plot.getBottom() - y);
                (isSoft ? softLine : line).add(x, y, 2);
            }
            // What protection takes hangs from the top, in the same dB.
            if (taken[i].high > 0.1f)
                limits.add(x, plot.getY(), std::max(2, yOf(-static_cast<double>(taken[i].high)) - plot.getY()));
        }
    }
    g.setColour(p.dim);
    g.fillRect(visible.getX(), touch, visible.getWidth(), 1);
    const auto text = tr("threshold {0} dB", {juce::String(juce::roundToInt(shown->touch))});
    const juce::Rectangle<int> label(plot.getX() + 3, touch - 14, smallFont().getStringWidth(text) + 8, 13);
    g.setColour(p.well.withAlpha(0.75f));
    g.fillRect(label);
    g.setColour(p.text);
    g.setFont(smallFont());
    g.drawText(text, label.withTrimmedLeft(3), juce::Justification::centredLeft, false);
}

void ActuatorRow::paintLosses(juce::Graphics& g, juce::Rectangle<int> plot)
{
    const auto clip = model.clip();
    if (!clip || shown->sources.empty() || plot.isEmpty())
        return;
    const bool dark = darkOf(*this);
    const TimeAxis& axis = viewState.axis();
    const bool sized =
        losses.isValid() && losses.getWidth() == plot.getWidth() && losses.getHeight() == plot.getHeight();
    if (!sized || lossStale || axis != lossAxis || dark != lossDark)
        drawLosses(*clip, plot, axis, dark);
    g.drawImageAt(losses, plot.getX(), plot.getY());
}

void ActuatorRow::drawLosses(const Clip& clip, juce::Rectangle<int> plot, const TimeAxis& axis, bool dark)
{
    const Palette& p = paletteFor(*this);
    if (losses.getWidth() != plot.getWidth() || losses.getHeight() != plot.getHeight())
        losses = juce::Image(juce::Image::RGB, plot.getWidth(), plot.getHeight(), false, juce::SoftwareImageType());
    lossAxis = axis;
    lossDark = dark;
    lossStale = false;
    const auto pixel = [](juce::Colour colour)
    {
        juce::PixelRGB result;
        result.setARGB(255, colour.getRed(), colour.getGreen(), colour.getBlue());
        return result;
    };
    const juce::PixelRGB ground = pixel(p.well), gap = pixel(p.card);
    std::array<juce::PixelRGB, 6> lost;
    for (std::size_t i = 0; i < lost.size(); ++i)
        lost[i] = pixel(lossColour(static_cast<Loss>(i), p));
    std::vector<std::size_t> rowOf(static_cast<std::size_t>(plot.getHeight()));
    for (std::size_t y = 0; y < rowOf.size(); ++y)
        rowOf[y] = sourceAt(static_cast<double>(y) + 0.5);
    juce::Image::BitmapData pixels(losses, juce::Image::BitmapData::writeOnly);
    std::vector<juce::PixelRGB> line(static_cast<std::size_t>(plot.getWidth()));
    for (std::size_t y = 0; y < rowOf.size(); ++y)
    {
        if (y > 0 && rowOf[y] == rowOf[y - 1] && y + 1 < rowOf.size() && rowOf[y + 1] != rowOf[y])
            std::fill(line.begin(), line.end(), gap);
        else if (y == 0 || rowOf[y] != rowOf[y - 1])
        {
            const auto& source = shown->sources[rowOf[y]];
            const juce::Colour colour = laneColour(clip, source.lane, p, dark);
            std::array<juce::PixelRGB, shades> played;
            for (int k = 0; k < shades; ++k)
                played[static_cast<std::size_t>(k)] =
                    pixel(p.well.interpolatedWith(colour, 0.2f + 0.8f * static_cast<float>(k) / (shades - 1)));
            for (int x = 0; x < plot.getWidth(); ++x)
            {
                const auto shade = shadeOf(source, axis.timeAt(x), axis.timeAt(x + 1.0), shown->touch);
                line[static_cast<std::size_t>(x)] = !shade ? ground
                                                    : shade->loss != Loss::none
                                                        ? lost[static_cast<std::size_t>(shade->loss)]
                                                        : played[static_cast<std::size_t>(shade->step)];
            }
        }
        std::copy(line.begin(), line.end(),
                  reinterpret_cast<juce::PixelRGB*>(pixels.getLinePointer(static_cast<int>(y))));
    }
}

std::vector<Command> ActuatorRow::contextCommands() const
{
    return {fitToActuator, feelAlike, menuLine, loadProfile, measureActuator, menuLine, showActuator};
}

} // namespace pacini::editor
