#include "cli/plot/ResponseFigure.h"

#include <pacini/foundation/Units.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini::plot
{

namespace
{
struct Range
{
    double low = 0.0;
    double high = 0.0;
};

Range frequencyRange(const ResponseFigureContent& content)
{
    Range range{20.0, 1000.0};
    bool first = true;
    for (const NamedResponse& shown : content.responses)
    {
        if (shown.response.frequency.empty())
            continue;
        const double low = shown.response.frequency.front();
        const double high = shown.response.frequency.back();
        range = first ? Range{low, high} : Range{std::min(range.low, low), std::max(range.high, high)};
        first = false;
    }
    return range;
}

std::vector<Point> pointsOf(const FrequencyResponse& response)
{
    std::vector<Point> points;
    for (std::size_t i = 0; i < response.size(); ++i)
        points.push_back({response.frequency[i], response.level[i]});
    return points;
}

/// Whole tens around the values, at least 20 dB.
Axis levelAxis(std::string title, const std::vector<Series>& series, double most)
{
    double low = 1e9;
    double high = -1e9;
    for (const Series& one : series)
        if (const auto* line = std::get_if<Line>(&one))
            for (const Point& point : line->points)
            {
                low = std::min(low, point.y);
                high = std::max(high, point.y);
            }
    if (low > high)
        return {std::move(title), Scale::linear, -20.0, 0.0, {}};
    high = 10.0 * std::ceil((high + 2.0) / 10.0);
    low = std::max(10.0 * std::floor((low - 1.0) / 10.0), high - most);
    return {std::move(title), Scale::linear, std::min(low, high - 20.0), high, {}};
}

Stroke strokeFor(ResponseRole role, const Look& look)
{
    const double hair = look.metrics.hair();
    switch (role)
    {
    case ResponseRole::placement:
        return {look.theme.series(0).withAlpha(0.35), hair};
    case ResponseRole::outlier:
        return {look.theme.series(3).withAlpha(0.7), hair};
    case ResponseRole::noise:
        return {look.theme.series(4).withAlpha(0.8), hair};
    case ResponseRole::measured:
        return {look.theme.series(0), 2.2 * hair};
    case ResponseRole::flattened:
        return {look.theme.series(1), 2.2 * hair};
    }
    return {look.theme.series(0), hair};
}

void markRange(Panel& panel, const ResponseFigureContent& content, bool listed, const Look& look)
{
    if (!(content.highFrequency > content.lowFrequency))
        return;
    panel.series.insert(panel.series.begin(),
                        Area{fmt::format("range {:.0f}\u2013{:.0f} Hz", content.lowFrequency, content.highFrequency),
                             {{content.lowFrequency, panel.y.high}, {content.highFrequency, panel.y.high}},
                             {panel.y.low, panel.y.low},
                             look.theme.series(2).withAlpha(0.09),
                             listed});
}

Panel responsePanel(const ResponseFigureContent& content, const Axis& frequency, const Look& look)
{
    Panel panel;
    panel.title = "Acceleration at full drive";
    panel.x = frequency;
    panel.share = 2.0;
    std::vector<std::string> named;
    for (const NamedResponse& shown : content.responses)
    {
        const bool isFirst = std::find(named.begin(), named.end(), shown.name) == named.end();
        named.push_back(shown.name);
        panel.series.push_back(
            Line{shown.name, pointsOf(shown.response), strokeFor(shown.role, look), {}, {}, isFirst});
    }
    panel.y = levelAxis(content.absolute ? "dB re 1 m/s\u00b2" : "dB, relative", panel.series, 100.0);
    if (const auto& linearity = content.linearity)
    {
        const double top = linearity->level + linearity->tolerance;
        const double bottom = linearity->level - linearity->tolerance;
        panel.series.insert(panel.series.begin(),
                            Area{fmt::format("\u00b1{:.3g} dB", linearity->tolerance),
                                 {{linearity->lowFrequency, top}, {linearity->highFrequency, top}},
                                 {bottom, bottom},
                                 look.theme.series(1).withAlpha(0.16)});
    }
    markRange(panel, content, true, look);
    return panel;
}

/// The sum thick, the orders thin. The axis is that of the sum and two decades below its largest value at most: weaker
/// orders are noise.
Panel distortionPanel(const ResponseFigureContent& content, const Axis& frequency, const Look& look)
{
    Panel panel;
    panel.title = "Harmonic distortion";
    panel.x = frequency;
    const auto positive = [](const FrequencyResponse& response)
    {
        auto points = pointsOf(response);
        std::erase_if(points, [](const Point& point) { return !(point.y > 0.0); });
        return points;
    };
    std::vector<Point> sum = positive(content.distortion->response);
    std::vector<double> values;
    for (const Point& point : sum)
        values.push_back(point.y);
    for (const NamedResponse& harmonic : content.harmonics)
        for (const double value : harmonic.response.level)
            values.push_back(value);
    const double largest = values.empty() ? 1.0 : *std::max_element(values.begin(), values.end());
    std::erase_if(values, [=](double value) { return !(value > 1e-2 * largest); });
    panel.y = axisAround("% of the fundamental", Scale::logarithmic, values);
    std::size_t colour = 0;
    for (const NamedResponse& harmonic : content.harmonics)
        panel.series.push_back(Line{
            harmonic.name, positive(harmonic.response), Stroke{look.theme.series(colour++), look.metrics.hair()}, {}});
    panel.series.push_back(
        Line{content.distortion->name, std::move(sum), Stroke{look.theme.series(5), 1.6 * look.metrics.hair()}, {}});
    return panel;
}

/// The axis is that of the marked range, if there is one: outside it noise and the edges of the sweep say nothing.
Panel groupDelayPanel(const ResponseFigureContent& content, const Axis& frequency, const Look& look)
{
    const NamedResponse& delay = *content.groupDelay;
    const bool marked = content.highFrequency > content.lowFrequency;
    std::vector<double> values;
    for (const Point& point : pointsOf(delay.response))
        if (!marked || (point.x >= content.lowFrequency && point.x <= content.highFrequency))
            values.push_back(point.y);
    Panel panel;
    panel.title = "Group delay";
    panel.x = frequency;
    panel.y = axisAround("ms after the arrival", Scale::linear, values);
    panel.series.push_back(
        Line{delay.name, pointsOf(delay.response), Stroke{look.theme.series(0), 1.6 * look.metrics.hair()}, {}});
    return panel;
}

Panel equalizerPanel(const ResponseFigureContent& content, const Axis& frequency, const Look& look)
{
    constexpr int count = 600;
    const auto filter = designEqualizer(content.equalizer, content.sampleRate);
    Line curve{"equaliser", {}, Stroke{look.theme.series(1), 2.0 * look.metrics.hair()}, {}};
    Line marks{"sections", {}, {}, Marker{MarkerShape::circle, look.theme.series(1)}};
    const auto gainAt = [&](double f)
    {
        return Decibels::fromGain(std::max(std::abs(filter.response(Hertz(f), content.sampleRate)), 1e-10)).value;
    };
    for (int i = 0; i < count; ++i)
    {
        const double f = frequency.low * std::pow(frequency.high / frequency.low, static_cast<double>(i) / (count - 1));
        if (f < 0.49 * content.sampleRate)
            curve.points.push_back({f, gainAt(f)});
    }
    for (const EqualizerSection& section : content.equalizer)
        if (section.frequency >= frequency.low && section.frequency <= frequency.high &&
            section.frequency < 0.49 * content.sampleRate)
            marks.points.push_back({section.frequency, gainAt(section.frequency)});
    Panel panel;
    panel.title =
        fmt::format("Equaliser of {} section{}", content.equalizer.size(), content.equalizer.size() == 1 ? "" : "s");
    panel.x = frequency;
    panel.series = {std::move(curve), std::move(marks)};
    panel.y = levelAxis("Gain (dB)", panel.series, 60.0);
    return panel;
}
} // namespace

Figure makeResponseFigure(const ResponseFigureContent& content, const FigureStyle& style)
{
    const Look look = lookFor(style);
    const Range range = frequencyRange(content);
    const Axis frequency{"Frequency (Hz)", Scale::logarithmic, range.low, range.high, {}};
    Figure figure{content.title, content.subtitle, {responsePanel(content, frequency, look)}};
    if (content.distortion)
        figure.panels.push_back(distortionPanel(content, frequency, look));
    if (content.groupDelay)
        figure.panels.push_back(groupDelayPanel(content, frequency, look));
    if (!content.equalizer.empty())
        figure.panels.push_back(equalizerPanel(content, frequency, look));
    return figure;
}

} // namespace pacini::plot
