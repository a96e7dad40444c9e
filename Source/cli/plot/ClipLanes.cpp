#include "cli/plot/ClipLanes.h"

#include "cli/plot/ShownCurve.h"

#include <pacini/foundation/Units.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace pacini::plot
{

namespace
{
std::string hertz(double frequency)
{
    return fmt::format("{:.{}f}", frequency, frequency < 10.0 ? 1 : 0);
}

/// The bands from the lowest to the highest.
std::vector<const Band*> bandsByFrequency(const Clip& clip)
{
    std::vector<const Band*> bands;
    for (const Band& band : clip.bands)
        bands.push_back(&band);
    std::stable_sort(bands.begin(), bands.end(),
                     [](const Band* a, const Band* b) { return a->centreFrequency < b->centreFrequency; });
    return bands;
}

Colour bandColour(std::size_t i, std::size_t bands, const Look& look)
{
    return look.theme.ordered(bands > 1 ? static_cast<double>(i) / static_cast<double>(bands - 1) : 0.5);
}

struct Lane
{
    std::string name;
    std::string label;
    const Curve* curve = nullptr;
    Colour colour;
};

std::vector<Lane> lanesOf(const Clip& clip, const Look& look)
{
    std::vector<Lane> lanes;
    const auto bands = bandsByFrequency(clip);
    for (std::size_t i = 0; i < bands.size(); ++i)
    {
        const std::string centre = hertz(bands[i]->centreFrequency);
        lanes.push_back(
            {"amplitude at " + centre + " Hz", centre, &bands[i]->amplitude, bandColour(i, bands.size(), look)});
    }
    for (const NoiseBand& noise : clip.noise)
    {
        const std::string edges = hertz(noise.lowFrequency) + "\u2013" + hertz(noise.highFrequency);
        lanes.push_back({"noise " + edges + " Hz", "noise " + edges, &noise.amplitude, look.theme.quietText});
    }
    return lanes;
}

double largest(const std::vector<Point>& points)
{
    double peak = 0.0;
    for (const Point& point : points)
        peak = std::max(peak, point.y);
    return peak;
}

std::string decibelText(double amplitude)
{
    if (amplitude <= 0.0)
        return "silent";
    const double level = std::round(Decibels::fromGain(amplitude).value) + 0.0;
    return fmt::format("{}{:.0f} dB", level < 0.0 ? "\u2212" : "", std::abs(level));
}
} // namespace

Panel amplitudeLanes(const Clip& clip, TimeRange range, const Look& look)
{
    constexpr double laneHeight = 0.88; // of the distance between lanes
    const auto lanes = lanesOf(clip, look);
    std::vector<std::vector<Point>> curves;
    double strongest = 0.0;
    for (const Lane& lane : lanes)
    {
        curves.push_back(shownCurve(*lane.curve, range, clip.duration));
        strongest = std::max(strongest, largest(curves.back()));
    }

    Panel panel;
    panel.title = "Amplitude of the bands (each lane up to its peak, at the right re full drive)";
    panel.y = {"Centre (Hz)", Scale::linear, -0.12, static_cast<double>(lanes.size()), {}};
    panel.crossGrid = false;
    panel.share = std::clamp(0.22 * static_cast<double>(lanes.size()), 0.8, 3.0);
    for (std::size_t i = 0; i < lanes.size(); ++i)
    {
        const Lane& lane = lanes[i];
        const auto base = static_cast<double>(i);
        const double peak = largest(curves[i]);
        panel.y.fixedTicks.push_back({base + 0.5 * laneHeight, lane.label});
        panel.rightLabels.push_back({base + 0.5 * laneHeight, decibelText(peak)});
        panel.series.push_back(Line{"base line",
                                    {{range.from, base}, {range.to, base}},
                                    Stroke{look.theme.grid, look.metrics.hair(), 0.0, false},
                                    {},
                                    {},
                                    false});
        if (peak <= 0.0)
            continue;
        const auto inLane = [&](std::vector<Point> points)
        {
            for (Point& point : points)
                point.y = base + laneHeight * point.y / peak;
            return points;
        };
        const double opacity = std::clamp(0.55 + 0.5 * std::log10(peak / strongest) / 2.0, 0.12, 0.55);
        const auto line = inLane(curves[i]);
        panel.series.push_back(
            Area{lane.name, line, std::vector<double>(line.size(), base), lane.colour.withAlpha(opacity), false});
        panel.series.push_back(Line{lane.name, line, Stroke{lane.colour, look.metrics.hair()}, {}, {}, false});
        panel.series.push_back(Line{lane.name,
                                    inLane(shownBreakpoints(*lane.curve, range)),
                                    {},
                                    plot::Marker{MarkerShape::circle, lane.colour, 3.2 * look.metrics.hair()},
                                    {},
                                    false});
    }
    return panel;
}

Panel pitchPanel(const Clip& clip, TimeRange range, int columns, const Look& look)
{
    const auto bands = bandsByFrequency(clip);
    const auto count = static_cast<std::size_t>(std::max(columns, 2));
    const double width = (range.to - range.from) / static_cast<double>(count);
    std::vector<double> frequencies;
    std::vector<std::vector<double>> peaks;
    double strongest = 0.0;
    for (const Band* band : bands)
    {
        frequencies.insert(frequencies.end(), {band->lowFrequency, band->centreFrequency, band->highFrequency});
        for (const Breakpoint& point : band->pitch)
            frequencies.push_back(point.value);
        peaks.push_back(columnPeaks(band->amplitude, range, clip.duration, count));
        strongest = std::max(strongest, *std::max_element(peaks.back().begin(), peaks.back().end()));
    }
    for (const Breakpoint& point : clip.centroid)
        frequencies.push_back(point.value);

    Panel panel;
    panel.title = bands.empty() ? "Spectral centroid" : "Pitch of the bands (as thick as they are strong)";
    panel.y = axisAround("Frequency (Hz)", Scale::logarithmic, frequencies);
    panel.share = 2.0;
    const double octaves = std::log2(panel.y.high / panel.y.low);
    const double thickest = bands.empty() ? 0.0 : 0.8 * octaves / static_cast<double>(bands.size() + 1);
    for (std::size_t i = 0; i < bands.size(); ++i)
    {
        const Band& band = *bands[i];
        Area ribbon;
        ribbon.name = "pitch at " + hertz(band.centreFrequency) + " Hz";
        ribbon.fill = bandColour(i, bands.size(), look).withAlpha(0.8);
        ribbon.listed = false;
        for (std::size_t c = 0; c < count && strongest > 0.0; ++c)
        {
            const double time = range.from + (static_cast<double>(c) + 0.5) * width;
            const double centre = band.pitch.empty() ? band.centreFrequency : valueAt(band.pitch, time);
            const double half = std::exp2(0.5 * thickest * std::sqrt(peaks[i][c] / strongest));
            ribbon.upper.push_back({time, centre * half});
            ribbon.lower.push_back(centre / half);
        }
        panel.series.push_back(std::move(ribbon));
    }
    if (!clip.centroid.empty())
    {
        const Colour colour = look.theme.series(1);
        panel.series.push_back(Line{"spectral centroid",
                                    shownCurve(clip.centroid, range, clip.duration),
                                    Stroke{colour, 1.6 * look.metrics.hair()},
                                    {}});
        panel.series.push_back(Line{"spectral centroid",
                                    shownBreakpoints(clip.centroid, range),
                                    {},
                                    plot::Marker{MarkerShape::circle, colour, 5.0 * look.metrics.hair()}});
    }
    return panel;
}

} // namespace pacini::plot
