#include "cli/plot/SceneFigure.h"

#include "cli/Console.h"
#include "cli/plot/ShownCurve.h"
#include "io/JsonText.h"

#include <pacini/foundation/Units.h>
#include <pacini/synthesis/SceneTimeline.h>
#include <pacini/synthesis/SingleVoice.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini::plot
{

namespace
{

constexpr double barHeight = 0.86;      // of the distance between lanes
constexpr std::size_t maxLanes = 32;    // more are too low to be read
constexpr std::size_t maxGainLines = 7; // as many colours there are

/// A play in the figure: its level in every column, from all actuators and from each.
struct ShownPlay
{
    const TimedPlay* timed = nullptr;
    std::vector<double> level;
};

std::string nameOfClip(const Scene& scene, std::size_t clip)
{
    const std::string& name = scene.clips[clip].name;
    return name.empty() ? fmt::format("clips[{}]", clip) : name;
}

std::string nameOfPlay(const Scene& scene, std::size_t play)
{
    const std::string& name = scene.plays[play].name;
    return name.empty() ? nameOfClip(scene, scene.plays[play].clip) : name;
}

/// The strength of a clip over its time, events included.
Curve strengthOf(const Clip& clip)
{
    return clip.envelope.empty() ? singleVoiceOf(clip).amplitude : clip.envelope;
}

/// The gain towards all actuators together.
double gainAt(const PlayTimeline& timeline, double time)
{
    double power = 0.0;
    for (const Curve& gain : timeline.gains)
        power += std::pow(valueAt(gain, time), 2.0);
    return std::sqrt(power);
}

/// Time of the middle of a column.
double middleOf(std::size_t column, std::size_t columns, TimeRange range)
{
    return range.from + (range.to - range.from) * (static_cast<double>(column) + 0.5) / static_cast<double>(columns);
}

/// The largest strength of the clip in each column that the play sounds in, without its gain. Events are as strong as
/// they are, in the columns of their first 10 ms.
std::vector<double> levelsOf(const Scene& scene, const TimedPlay& timed, const Curve& strength, TimeRange range,
                             std::size_t columns)
{
    constexpr double eventLength = 0.01; // s
    const ScenePlay& play = scene.plays[timed.play];
    const Clip& clip = scene.clips[play.clip];
    const double length = play.loop > 0.0 ? play.loop : clip.duration;
    const PlayClock clock = makeClock(play.stretch, timed.timeline);
    const double width = (range.to - range.from) / static_cast<double>(columns);
    std::vector<double> levels(columns, 0.0);
    for (std::size_t c = 0; c < columns; ++c)
    {
        const double left = std::max(range.from + width * static_cast<double>(c), timed.start);
        const double right = std::min(range.from + width * static_cast<double>(c + 1), timed.end);
        if (right <= left)
            continue;
        // The stretch of the clip that the column shows; a loop that fits into it is shown whole.
        const double first = clock.clipAt(left - timed.start), last = clock.clipAt(right - timed.start);
        const double from = play.loop > 0.0 ? std::fmod(first, length) : first;
        const double to = std::min(from + (last - first), from + length);
        const auto peak = [&](double a, double b)
        {
            double most = std::max(valueAt(strength, a), valueAt(strength, b));
            const auto earlier = [](const Breakpoint& point, double time)
            {
                return point.time < time;
            };
            for (auto next = std::lower_bound(strength.begin(), strength.end(), a, earlier);
                 next != strength.end() && next->time <= b; ++next)
                most = std::max(most, next->value);
            for (auto event = std::lower_bound(clip.transients.begin(), clip.transients.end(), a - eventLength,
                                               [](const Transient&e, double time) { return e.time < time; });
                 event != clip.transients.end() && event->time <= b; ++event)
                most = std::max(most, event->amplitude);
            return most;
        };
        levels[c] = peak(from, std::min(to, length));
        if (to > length && play.loop > 0.0)
            levels[c] = std::max(levels[c], peak(0.0, to - length));
    }
    return levels;
}

/// The lane of each play: the first that is free when it starts. More than there is room for share the last.
std::vector<std::size_t> lanesOf(const SceneTimeline& timeline)
{
    std::vector<std::size_t> order(timeline.plays.size()), lanes(timeline.plays.size(), 0);
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return timeline.plays[a].start < timeline.plays[b].start; });
    const bool one = order.size() <= maxLanes; // each play gets a lane of its own, in the order of the scene
    std::vector<double> ends;
    for (const std::size_t i : order)
    {
        if (one)
        {
            lanes[i] = i;
            continue;
        }
        std::size_t lane = 0;
        while (lane < ends.size() && ends[lane] > timeline.plays[i].start)
            ++lane;
        lane = std::min(lane, maxLanes - 1);
        ends.resize(std::max(ends.size(), lane + 1), 0.0);
        ends[lane] = timeline.plays[i].end;
        lanes[i] = lane;
    }
    return lanes;
}

std::string panText(const Scene& scene, const ScenePlay& play)
{
    const std::string gain = fmt::format("{}{:g} dB", play.gain < 0.0 ? "\u2212" : "", std::abs(play.gain));
    return scene.actuators > 1 ? fmt::format("{}, pan {:.2g}", gain, play.pan) : gain;
}

Colour clipColour(std::size_t clip, const Look& look)
{
    return look.theme.series(clip);
}

/// The tops of the columns that lie within `from` to `to`, as a line.
std::vector<Point> columnLine(const std::vector<double>& values, TimeRange range, double from, double to)
{
    std::vector<Point> line;
    for (std::size_t c = 0; c < values.size(); ++c)
        if (const double time = middleOf(c, values.size(), range); time >= from && time <= to)
            line.push_back({time, values[c]});
    return line;
}

void addBar(Panel& panel, const Scene& scene, const ShownPlay& shown, std::size_t lane, double strongest,
            TimeRange range, bool listed, const Look& look)
{
    const TimedPlay& timed = *shown.timed;
    const double from = std::max(timed.start, range.from), to = std::min(timed.end, range.to);
    if (to <= from)
        return;
    const auto base = -static_cast<double>(lane) - 1.0; // the first play is the uppermost
    const std::size_t clip = scene.plays[timed.play].clip;
    const Colour colour = clipColour(clip, look);
    panel.series.push_back(Area{nameOfClip(scene, clip),
                                {{from, base + barHeight}, {to, base + barHeight}},
                                {base, base},
                                colour.withAlpha(0.16),
                                false});
    std::vector<Point> line = columnLine(shown.level, range, from, to);
    for (Point& point : line)
        point.y = base + (strongest > 0.0 ? barHeight * point.y / strongest : 0.0);
    panel.series.push_back(
        Area{nameOfClip(scene, clip), line, std::vector<double>(line.size(), base), colour.withAlpha(0.75), listed});
    panel.series.push_back(Line{"edges",
                                {{from, base}, {from, base + barHeight}},
                                Stroke{colour, 1.6 * look.metrics.hair(), 0.0, false},
                                {},
                                {},
                                false});
}

/// Marks where the pitch or the speed of a play changes.
void addChanges(Panel& panel, const Scene& scene, const std::vector<std::size_t>& lanes, const Look& look)
{
    std::vector<Point> points;
    for (const SceneChange& change : scene.changes)
        if (change.parameter == SceneParameter::transposition || change.parameter == SceneParameter::stretch)
            points.push_back({change.time, -static_cast<double>(lanes[change.play]) - 1.0 + 0.5 * barHeight});
    if (!points.empty())
        panel.series.push_back(Line{"change of pitch or speed",
                                    std::move(points),
                                    {},
                                    plot::Marker{MarkerShape::diamond, look.theme.text, 8.0 * look.metrics.hair()}});
}

Panel playsPanel(const Scene& scene, const std::vector<ShownPlay>& plays, const std::vector<std::size_t>& lanes,
                 TimeRange range, const Look& look)
{
    const std::size_t count = lanes.empty() ? 1 : *std::max_element(lanes.begin(), lanes.end()) + 1;
    double strongest = 0.0;
    for (const ShownPlay& shown : plays)
        for (const double level : shown.level)
            strongest = std::max(strongest, level);
    Panel panel;
    panel.title = "Plays (strength as it is played, all on one scale)";
    panel.y = {"", Scale::linear, -static_cast<double>(count) - 0.1, 0.05, {}};
    panel.crossGrid = false;
    panel.share = std::clamp(0.35 * static_cast<double>(count), 1.0, 5.0);
    const bool one = plays.size() <= maxLanes;
    std::set<std::size_t> named; // clips in the legend
    for (std::size_t i = 0; i < plays.size(); ++i)
    {
        const std::size_t clip = scene.plays[i].clip;
        addBar(panel, scene, plays[i], lanes[i], strongest, range, named.insert(clip).second, look);
    }
    // Ticks rise.
    for (std::size_t i = one ? plays.size() : 0; i-- > 0;)
    {
        const double middle = -static_cast<double>(lanes[i]) - 1.0 + 0.5 * barHeight;
        panel.y.fixedTicks.push_back({middle, shownText(nameOfPlay(scene, i))});
        panel.rightLabels.push_back({middle, panText(scene, scene.plays[i])});
    }
    if (!one)
        panel.y.fixedTicks.push_back({-0.5, fmt::format("{} plays", plays.size())});
    addChanges(panel, scene, lanes, look);
    return panel;
}

/// All plays together at each actuator: the root of the summed powers, as their waves are not in step.
Panel actuatorsPanel(const Scene& scene, const std::vector<ShownPlay>& plays, TimeRange range, std::size_t columns,
                     const Look& look)
{
    const auto actuators = static_cast<std::size_t>(scene.actuators);
    std::vector<std::vector<double>> levels(actuators, std::vector<double>(columns, 0.0));
    double strongest = 0.0;
    for (std::size_t a = 0; a < actuators; ++a)
        for (std::size_t c = 0; c < columns; ++c)
        {
            const double time = middleOf(c, columns, range);
            double power = 0.0;
            for (const ShownPlay& shown : plays)
                if (shown.level[c] > 0.0)
                {
                    const double all = gainAt(shown.timed->timeline, time);
                    const double here = valueAt(shown.timed->timeline.gains[a], time);
                    power += all > 0.0 ? std::pow(shown.level[c] * here / all, 2.0) : 0.0;
                }
            levels[a][c] = std::sqrt(power);
            strongest = std::max(strongest, levels[a][c]);
        }
    Panel panel;
    panel.title = "Level at each actuator, all plays together (1 = full drive)";
    panel.y = {"Actuator", Scale::linear, -static_cast<double>(actuators) - 0.1, 0.05, {}};
    panel.crossGrid = false;
    panel.legend = LegendPlace::none;
    panel.share = std::clamp(0.6 * static_cast<double>(actuators), 1.0, 4.0);
    for (std::size_t i = actuators; i-- > 0;)
    {
        const double base = -static_cast<double>(i) - 1.0;
        const Colour colour =
            look.theme.ordered(actuators > 1 ? static_cast<double>(i) / static_cast<double>(actuators - 1) : 0.5);
        double peak = 0.0;
        std::vector<Point> line = columnLine(levels[i], range, range.from, range.to);
        for (Point& point : line)
        {
            peak = std::max(peak, point.y);
            point.y = base + (strongest > 0.0 ? barHeight * point.y / strongest : 0.0);
        }
        panel.y.fixedTicks.push_back({base + 0.5 * barHeight, std::to_string(i + 1)});
        panel.rightLabels.push_back({base + 0.5 * barHeight, fmt::format("peak {:.2f}", peak)});
        panel.series.push_back(
            Area{"level", line, std::vector<double>(line.size(), base), colour.withAlpha(0.6), false});
        panel.series.push_back(Line{"level", line, Stroke{colour, look.metrics.hair()}, {}, {}, false});
    }
    return panel;
}

/// The gains of the plays that have changes of it, in dB; silence is the lower edge.
Panel gainsPanel(const Scene& scene, const SceneTimeline& timeline, const std::vector<std::size_t>& changing,
                 TimeRange range, const Look& look)
{
    constexpr double quietest = -60.0; // dB
    const double whole = sceneGain(scene.gain);
    Panel panel;
    panel.title = changing.size() > maxGainLines
                      ? fmt::format("Gain of the first {} of {} plays that change it", maxGainLines, changing.size())
                      : "Gain of the plays that change it";
    panel.share = 1.2;
    double low = 0.0, high = 0.0;
    for (std::size_t k = 0; k < std::min(changing.size(), maxGainLines); ++k)
    {
        const TimedPlay& timed = timeline.plays[changing[k]];
        Curve gain;
        // Every actuator's curve bends where the gain does.
        for (const Breakpoint& point : timed.timeline.gains.front())
        {
            const double level = gainAt(timed.timeline, point.time) / std::max(whole, 1e-9);
            gain.push_back({point.time, std::max(Decibels::fromGain(std::max(level, 1e-9)).value, quietest)});
        }
        std::vector<Point> points;
        for (const Point& point :
             shownCurve(gain, {std::max(range.from, timed.start), std::min(range.to, timed.end)}, timeline.duration))
        {
            low = std::min(low, point.y);
            high = std::max(high, point.y);
            points.push_back(point);
        }
        panel.series.push_back(Line{nameOfPlay(scene, changing[k]),
                                    std::move(points),
                                    Stroke{look.theme.series(k), 1.6 * look.metrics.hair()},
                                    {}});
    }
    panel.y = {"Gain (dB)", Scale::linear, low - 3.0, high + 3.0, {}};
    return panel;
}

std::string counted(std::size_t number, std::string_view one)
{
    return fmt::format("{} {}{}", number, one, number == 1 ? "" : "s");
}
} // namespace

Figure makeSceneFigure(const Scene& scene, std::string title, TimeRange range, const FigureStyle& style)
{
    const Look look = lookFor(style);
    const SceneTimeline timeline = pacini::timelineOf(scene);
    const auto columns = static_cast<std::size_t>(std::max(style.size.width / 2, 2));
    std::vector<Curve> strengths;
    for (const Clip& clip : scene.clips)
        strengths.push_back(strengthOf(clip));
    std::vector<ShownPlay> plays;
    for (const TimedPlay& timed : timeline.plays)
    {
        ShownPlay shown{&timed, levelsOf(scene, timed, strengths[scene.plays[timed.play].clip], range, columns)};
        for (std::size_t c = 0; c < columns; ++c)
            if (shown.level[c] > 0.0)
                shown.level[c] *= gainAt(timed.timeline, middleOf(c, columns, range));
        plays.push_back(std::move(shown));
    }
    std::set<std::size_t> changing;
    for (const SceneChange& change : scene.changes)
        if (change.parameter == SceneParameter::gain)
            changing.insert(change.play);

    Figure figure{std::move(title),
                  fmt::format("{} \u00b7 {} \u00b7 {} of {} \u00b7 {}", cli::durationText(timeline.duration),
                              counted(static_cast<std::size_t>(scene.actuators), "actuator"),
                              counted(scene.plays.size(), "play"), counted(scene.clips.size(), "clip"),
                              counted(scene.changes.size(), "change")),
                  {}};
    figure.panels.push_back(playsPanel(scene, plays, lanesOf(timeline), range, look));
    figure.panels.push_back(actuatorsPanel(scene, plays, range, columns, look));
    if (!changing.empty())
        figure.panels.push_back(
            gainsPanel(scene, timeline, std::vector<std::size_t>(changing.begin(), changing.end()), range, look));
    for (Panel& panel : figure.panels)
        panel.x = {range.to - range.from > 120.0 ? "Time (min:s)" : "Time (s)", Scale::time, range.from, range.to, {}};
    return figure;
}

} // namespace pacini::plot
