#include "cli/study/StudyFigures.h"

#include "cli/plot/SvgCanvas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace pacini::cli
{

namespace
{
using namespace plot;

/// Names at 0, 1, 2 and so on.
Axis namedAxis(const std::vector<std::string>& names)
{
    Axis axis;
    axis.low = -0.5;
    axis.high = static_cast<double>(names.size()) - 0.5;
    for (std::size_t i = 0; i < names.size(); ++i)
        axis.fixedTicks.push_back({static_cast<double>(i), names[i]});
    return axis;
}

void addBox(Panel& panel, const study::SampleSummary& box, double x, double half, const std::string& name,
            const Colour& colour, const Look& look)
{
    const double width = 0.1 * look.metrics.text;
    const auto line = [&](std::vector<Point> points, double thickness)
    {
        Line made;
        made.name = name;
        made.listed = false;
        made.points = std::move(points);
        made.stroke = Stroke{colour, thickness};
        panel.series.push_back(std::move(made));
    };
    Area area;
    area.name = name;
    area.upper = {{x - half, box.upperQuartile}, {x + half, box.upperQuartile}};
    area.lower = {box.lowerQuartile, box.lowerQuartile};
    area.fill = colour.withAlpha(0.35);
    panel.series.push_back(std::move(area));
    line({{x - half, box.lowerQuartile},
          {x + half, box.lowerQuartile},
          {x + half, box.upperQuartile},
          {x - half, box.upperQuartile},
          {x - half, box.lowerQuartile}},
         width);
    line({{x - half, box.median}, {x + half, box.median}}, 3.0 * width);
    line({{x, box.upperQuartile}, {x, box.whiskers.high}}, width);
    line({{x, box.lowerQuartile}, {x, box.whiskers.low}}, width);
    const auto points = [&](std::vector<Point> at, MarkerShape shape)
    {
        Line made;
        made.name = name;
        made.listed = false;
        made.points = std::move(at);
        made.marker = plot::Marker{shape, colour, 0.5 * look.metrics.text};
        panel.series.push_back(std::move(made));
    };
    points({{x, box.mean}}, MarkerShape::diamond);
    std::vector<Point> beyond;
    for (const double value : box.outliers)
        beyond.push_back({x, value});
    if (!beyond.empty())
        points(std::move(beyond), MarkerShape::circle);
}
} // namespace

Figure boxPlots(const study::RatingAnalysis& analysis, const std::string& title, const FigureStyle& style)
{
    const Look look = lookFor(style);
    Panel panel;
    panel.x = namedAxis(analysis.stimuli);
    panel.x.title = "Stimulus";
    std::vector<double> values;
    const std::size_t groups = std::max<std::size_t>(analysis.plainGroups, 1);
    const double step = 0.8 / static_cast<double>(groups);
    for (std::size_t g = 0; g < analysis.plainGroups; ++g)
    {
        const study::GroupRatings& group = analysis.groups[g];
        values.insert(values.end(), group.all.begin(), group.all.end());
        for (std::size_t i = 0; i < analysis.stimuli.size(); ++i)
            if (!group.byStimulus[i].empty())
                addBox(panel, study::summaryOf(group.byStimulus[i]),
                       static_cast<double>(i) - 0.4 + step * (static_cast<double>(g) + 0.5), 0.4 * step,
                       group.name.empty() ? "all" : group.name, look.theme.series(g), look);
    }
    panel.y = axisAround("Rating", Scale::linear, values);
    return {
        title, "box: quartiles and median, diamond: mean, circles: beyond 1.5 quartile distances", {std::move(panel)}};
}

Figure intervalPlot(const std::vector<NamedInterval>& values, const std::string& title, const std::string& valueTitle,
                    const FigureStyle& style)
{
    const Look look = lookFor(style);
    Panel panel;
    panel.legend = LegendPlace::none;
    std::vector<std::string> names;
    std::vector<double> shown;
    for (const NamedInterval& one : values)
    {
        const auto x = static_cast<double>(names.size());
        names.push_back(one.name);
        shown.insert(shown.end(), {one.value, one.interval.low, one.interval.high});
        Line bar;
        bar.name = one.name;
        bar.points = {{x, one.interval.low}, {x, one.interval.high}};
        bar.stroke = Stroke{look.theme.series(0), 0.15 * look.metrics.text};
        panel.series.push_back(std::move(bar));
        Line point;
        point.name = one.name;
        point.points = {{x, one.value}};
        point.marker = plot::Marker{MarkerShape::circle, look.theme.series(0), 0.75 * look.metrics.text};
        panel.series.push_back(std::move(point));
    }
    panel.x = namedAxis(names);
    panel.y = axisAround(valueTitle, Scale::linear, shown);
    return {title, "with 95 % intervals", {std::move(panel)}};
}

Figure psychometricPlot(const std::vector<PsychometricCurve>& curves, const std::string& title,
                        const std::string& valueTitle, Scale scale, const FigureStyle& style)
{
    const Look look = lookFor(style);
    Panel panel;
    std::vector<double> values;
    for (std::size_t i = 0; i < curves.size(); ++i)
    {
        const PsychometricCurve& curve = curves[i];
        const Colour colour = look.theme.series(i);
        Area band;
        band.name = curve.name;
        band.fill = colour.withAlpha(0.2);
        band.listed = false;
        Line line;
        line.name = curve.name;
        line.stroke = Stroke{colour, 0.15 * look.metrics.text};
        for (const PsychometricCurve::At& at : curve.fitted)
        {
            band.upper.push_back({at.value, 100.0 * at.share95.high});
            band.lower.push_back(100.0 * at.share95.low);
            line.points.push_back({at.value, 100.0 * at.share});
            values.push_back(at.value);
        }
        panel.series.push_back(std::move(band));
        panel.series.push_back(std::move(line));
        std::size_t most = 1;
        for (const PsychometricCurve::Answers& seen : curve.answers)
            most = std::max(most, seen.trials);
        for (const PsychometricCurve::Answers& seen : curve.answers)
        {
            Line point;
            point.name = curve.name;
            point.listed = false;
            const auto trials = static_cast<double>(seen.trials);
            point.points = {{seen.value, 100.0 * static_cast<double>(seen.right) / trials}};
            // The area of a point tells how many answers it stands for.
            point.marker =
                plot::Marker{markerShape(i), colour,
                             look.metrics.text * std::max(0.25, 0.9 * std::sqrt(trials / static_cast<double>(most)))};
            panel.series.push_back(std::move(point));
        }
    }
    panel.x = axisAround(valueTitle, scale, values);
    panel.y = axisAround("Right answers, %", Scale::linear, {0.0, 100.0});
    return {title,
            "fitted to the answers of all participants, with 95 % bands; larger points: more answers",
            {std::move(panel)}};
}

Figure mapPlot(const study::Scaling& scaling, const std::vector<std::string>& names, const std::string& title,
               const FigureStyle& style)
{
    const Look look = lookFor(style);
    Panel panel;
    panel.legend = LegendPlace::none;
    Line line;
    line.name = title;
    std::vector<double> x, y;
    for (std::size_t i = 0; i < scaling.places.size(); ++i)
    {
        x.push_back(scaling.places[i][0]);
        y.push_back(scaling.places[i].size() > 1 ? scaling.places[i][1] : 0.0);
        line.points.push_back({x.back(), y.back()});
        line.labels.push_back(names[i]);
    }
    line.marker = plot::Marker{MarkerShape::circle, look.theme.series(0), 0.75 * look.metrics.text};
    panel.series.push_back(std::move(line));
    panel.x = axisAround("Dimension 1", Scale::linear, x);
    panel.y = axisAround("Dimension 2", Scale::linear, y);
    return {title, "", {std::move(panel)}};
}

Result<std::string> svgOf(const Figure& figure, const FigureStyle& style)
{
    SvgCanvas canvas(style.size.width, style.size.height, figure.title);
    drawFigure(canvas, figure, style);
    return canvas.finish();
}

} // namespace pacini::cli
