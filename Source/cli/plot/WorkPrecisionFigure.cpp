#include "cli/plot/WorkPrecisionFigure.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace pacini::plot
{

namespace
{
bool canBeShown(double value, Scale scale)
{
    return std::isfinite(value) && (scale != Scale::logarithmic || value > 0.0);
}
} // namespace

Figure makeFigure(const WorkPrecisionFigure& data, const FigureStyle& style)
{
    const Look look = lookFor(style);
    Panel panel;
    panel.legend = LegendPlace::right;
    std::vector<double> works;
    std::vector<double> errors;
    for (std::size_t i = 0; i < data.series.size(); ++i)
    {
        const WorkPrecisionSeries& series = data.series[i];
        const Colour colour = look.theme.series(i);
        Line line;
        line.name = series.name;
        line.marker = Marker{markerShape(i + i / 7), colour, 0.75 * look.metrics.text};
        if (series.joined)
            line.stroke = Stroke{colour, 0.13 * look.metrics.text, i < 7 ? 0.0 : 0.4 * look.metrics.text};
        for (const WorkPrecisionPoint& point : series.points)
        {
            if (!canBeShown(point.work, data.workScale) || !canBeShown(point.error, data.errorScale))
                continue;
            works.push_back(point.work);
            errors.push_back(point.error);
            line.points.push_back({point.work, point.error});
            line.labels.push_back(point.label);
        }
        panel.series.push_back(std::move(line));
    }
    panel.x = axisAround(data.workTitle, data.workScale, works);
    panel.y = axisAround(data.errorTitle, data.errorScale, errors);
    return {data.title, data.subtitle, {std::move(panel)}};
}

Result<std::size_t> writeWorkPrecision(const std::filesystem::path& path, const WorkPrecisionFigure& data,
                                       const FigureStyle& style)
{
    return writeFigure(path, makeFigure(data, style), style);
}

} // namespace pacini::plot
