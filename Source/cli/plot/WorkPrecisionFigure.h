#pragma once

// Work-precision diagram: error against work of several methods; the lower left corner is best.

#include "cli/plot/Figure.h"

#include <string>
#include <vector>

namespace pacini::plot
{

/// One setting of a method.
struct WorkPrecisionPoint
{
    double work = 0.0;   ///< in the unit of the x axis; 0 and below cannot be shown
    double error = 0.0;  ///< in the unit of the y axis; 0 and below cannot be shown
    std::string label{}; ///< such as the parameter's value; may be empty
};

/// One method: its points in the order of its parameter, which is how they are joined.
struct WorkPrecisionSeries
{
    std::string name;
    std::vector<WorkPrecisionPoint> points;
    bool joined = true; ///< false: points only
};

struct WorkPrecisionFigure
{
    std::string title;
    std::string subtitle{};
    std::string workTitle = "Time (s)";
    std::string errorTitle = "Error";
    Scale workScale = Scale::logarithmic;
    Scale errorScale = Scale::logarithmic;
    std::vector<WorkPrecisionSeries> series;
};

/// The figure of the points that can be shown: finite, and above 0 on a logarithmic axis. Series differ in colour and
/// in the shape of their markers; from the eighth on colours come
/// again with other shapes and dashed lines.
[[nodiscard]] Figure makeFigure(const WorkPrecisionFigure& data, const FigureStyle& style);

/// Draws it into a file (.png, .svg or .pdf); returns its size in bytes. Errors as in writePicture.
[[nodiscard]] Result<std::size_t> writeWorkPrecision(const std::filesystem::path& path, const WorkPrecisionFigure& data,
                                                     const FigureStyle& style = {{1200, 800}, false});

} // namespace pacini::plot
