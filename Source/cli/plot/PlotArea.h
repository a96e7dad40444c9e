#pragma once

// Coordinate mapping of a panel: axis values -> pixels of the canvas.

#include "cli/plot/Panel.h"

#include <algorithm>

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

} // namespace pacini::plot
