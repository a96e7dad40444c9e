#pragma once

// Drawing of data series, their labels and their samples in the legend.

#include "cli/plot/Panel.h"

#include <algorithm>
#include <vector>

namespace pacini::plot
{

struct PlotArea
{
    Rectangle box;
    const Axis& x;
    const Axis& y;

    /// Limited to a few widths beyond the box: renderers count pixels in short integers.
    [[nodiscard]] double atX(double value) const noexcept
    {
        return box.left + std::clamp(positionOn(x, value), -2.0, 3.0) * box.width();
    }
    [[nodiscard]] double atY(double value) const noexcept
    {
        return box.bottom - std::clamp(positionOn(y, value), -2.0, 3.0) * box.height();
    }
    [[nodiscard]] Point at(const Point& value) const noexcept { return {atX(value.x), atY(value.y)}; }

    [[nodiscard]] bool showsX(double value) const noexcept { return inside(positionOn(x, value)); }
    [[nodiscard]] bool showsY(double value) const noexcept { return inside(positionOn(y, value)); }

private:
    static bool inside(double position) noexcept { return position >= -1e-9 && position <= 1.0 + 1e-9; }
};

/// Points in pixels with at most four per column of pixels, its first, lowest, highest and last: drawn as lines they
/// cover the same pixels. Points that go back in x come back as they are.
[[nodiscard]] std::vector<Point> thinned(const std::vector<Point>& points);

/// Whether a series has anything to see in a plot of `width` pixels: points, and lines or markers that are not too
/// dense to be drawn.
[[nodiscard]] bool isSeen(const Series& series, double width);

/// Draws a series without its labels, cut off at the edge of the plot.
void drawSeries(Canvas& canvas, const Series& series, const PlotArea& area, const Look& look);

/// Adds the places of a line's markers to `taken`.
void markTaken(const Series& series, const PlotArea& area, std::vector<Rectangle>& taken);

/// Writes the labels of a line's points where there is room beside `taken`, and adds their places to it.
void labelPoints(Canvas& canvas, const Line& line, const PlotArea& area, const Look& look,
                 std::vector<Rectangle>& taken);

/// The sample of a series in a legend, centred at `at`, `width` pixels wide.
void drawSample(Canvas& canvas, const Series& series, Point at, double width);

} // namespace pacini::plot
