#include "cli/plot/ClipFigure.h"

#include "cli/Console.h"
#include "cli/plot/ClipLanes.h"
#include "cli/plot/ShownCurve.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

namespace pacini::plot
{

namespace
{
/// From 0, or from -largest, to a little more than the largest magnitude; to 1 when there is silence.
Axis amplitudeAxis(const std::vector<Point>& points, bool bothSigns)
{
    double largest = 0.0;
    for (const Point& point : points)
        largest = std::max(largest, std::abs(point.y));
    constexpr double silence = 1e-6; // -120 dB: rounding noise
    constexpr double nearFull = 0.8; // then full drive should be in the picture
    if (largest > nearFull)
        largest = std::max(largest, 1.0);
    const double end = largest > silence ? 1.08 * largest : 1.0;
    return {"Amplitude", Scale::linear, bothSigns ? -end : 0.0, end, {}};
}

Panel waveformPanel(const NamedWaveform& waveform, TimeRange range, const Look& look)
{
    const Colour colour = look.theme.series(0);
    Panel panel;
    panel.title = waveform.title;
    panel.x = timeAxis(range);
    panel.y = amplitudeAxis(waveform.points, true);
    panel.share = 1.0;
    panel.series.push_back(Line{waveform.title,
                                waveform.points,
                                Stroke{colour, look.metrics.hair()},
                                Marker{MarkerShape::circle, colour, 3.0 * look.metrics.hair()},
                                {},
                                false});
    return panel;
}

Panel envelopePanel(const Clip& clip, TimeRange range, const Look& look)
{
    const Colour colour = look.theme.series(1);
    const auto points = shownCurve(clip.envelope, range, clip.duration);
    Panel panel;
    panel.title = "Total envelope (1 = full drive)";
    panel.x = timeAxis(range);
    panel.y = amplitudeAxis(points, false);
    panel.share = 1.0;
    panel.series.push_back(
        Area{"area", points, std::vector<double>(points.size(), 0.0), colour.withAlpha(0.18), false});
    panel.series.push_back(Line{"total envelope", points, Stroke{colour, 1.4 * look.metrics.hair()}, {}});
    panel.series.push_back(Line{"breakpoints",
                                shownBreakpoints(clip.envelope, range),
                                {},
                                Marker{MarkerShape::circle, colour, 5.0 * look.metrics.hair()}});
    return panel;
}

Panel transientsPanel(const Clip& clip, TimeRange range, const Look& look)
{
    struct Kind
    {
        std::string_view name;
        double belowSharpness;
        MarkerShape shape;
        double colour;
    };
    constexpr std::array<Kind, 3> kinds = {Kind{"dull (sharpness below \u2153)", 1.0 / 3.0, MarkerShape::circle, 0.0},
                                           Kind{"medium", 2.0 / 3.0, MarkerShape::diamond, 0.5},
                                           Kind{"crisp (above \u2154)", 2.0, MarkerShape::triangle, 0.9}};
    Panel panel;
    panel.title = "Transients (level reached, 1 = full drive)";
    panel.x = timeAxis(range);
    panel.share = 0.8;
    std::vector<Point> all;
    std::array<std::vector<Point>, kinds.size()> points;
    for (const Transient& transient : clip.transients)
    {
        if (transient.time < range.from || transient.time > range.to)
            continue;
        const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                       [&](const Kind& k) { return transient.sharpness < k.belowSharpness; });
        points[static_cast<std::size_t>(kind - kinds.begin())].push_back({transient.time, transient.amplitude});
        all.push_back({transient.time, transient.amplitude});
    }
    panel.y = amplitudeAxis(all, false);
    for (std::size_t i = 0; i < kinds.size(); ++i)
    {
        const Colour colour = look.theme.ordered(kinds[i].colour);
        panel.series.push_back(Stems{std::string(kinds[i].name), std::move(points[i]), 0.0,
                                     Stroke{colour, 1.2 * look.metrics.hair()},
                                     Marker{kinds[i].shape, colour, 8.0 * look.metrics.hair()}});
    }
    return panel;
}

std::string count(std::size_t number, std::string_view one)
{
    return fmt::format("{} {}{}", number, one, number == 1 ? "" : "s");
}

std::string subtitleFor(const Clip& clip)
{
    const std::string length = clip.duration > 0.0 && clip.duration < 0.01
                                   ? fmt::format("{:.3g} ms", 1e3 * clip.duration)
                                   : cli::durationText(clip.duration);
    std::string text =
        fmt::format("{} \u00b7 {} \u00b7 {} \u00b7 {}", length, count(clip.bands.size(), "band"),
                    count(breakpointCount(clip), "breakpoint"), count(clip.transients.size(), "transient"));
    if (!clip.source.file.empty())
        text += " \u00b7 made from " + clip.source.file;
    return text;
}
} // namespace

Figure makeClipFigure(const Clip& clip, std::string title, const std::vector<NamedWaveform>& waveforms, TimeRange range,
                      const FigureStyle& style)
{
    const Look look = lookFor(style);
    Figure figure{std::move(title), subtitleFor(clip), {}};
    for (const NamedWaveform& waveform : waveforms)
        figure.panels.push_back(waveformPanel(waveform, range, look));
    if (!clip.envelope.empty())
        figure.panels.push_back(envelopePanel(clip, range, look));
    if (!clip.transients.empty())
        figure.panels.push_back(transientsPanel(clip, range, look));
    if (!clip.bands.empty() || !clip.noise.empty())
        figure.panels.push_back(amplitudeLanes(clip, range, look));
    if (!clip.bands.empty() || !clip.centroid.empty())
        figure.panels.push_back(pitchPanel(clip, range, style.size.width / 2, look));
    for (Panel& panel : figure.panels)
    {
        panel.x = timeAxis(range);
        for (const pacini::Marker& marker : clip.markers)
            panel.rules.push_back({marker.time, &panel == &figure.panels.front() ? marker.name : std::string()});
    }
    return figure;
}

} // namespace pacini::plot
