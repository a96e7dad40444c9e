#pragma once

// Data series of a panel: lines, areas and stems in the units of its axes.

#include "cli/plot/Canvas.h"
#include "cli/plot/Path.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace pacini::plot
{

enum class MarkerShape
{
    circle,
    square,
    triangle,
    diamond,
    cross,
    plus,
    triangleDown,
};

/// The i-th shape of a series in which the first seven differ.
[[nodiscard]] constexpr MarkerShape markerShape(std::size_t i) noexcept
{
    return static_cast<MarkerShape>(i % 7);
}

struct Marker
{
    MarkerShape shape = MarkerShape::circle;
    Colour colour;
    double size = 8.0; ///< pixels across
};

/// Points in the order they are joined. With neither stroke nor marker nothing is seen.
struct Line
{
    std::string name; ///< once in the legend for all series of this name
    std::vector<Point> points;
    std::optional<Stroke> stroke;
    std::optional<Marker> marker;      ///< at every point; left out where points are too dense to tell apart
    std::vector<std::string> labels{}; ///< of the points, or empty; left out where there is no room
    bool listed = true;                ///< in the legend
};

/// Area between two lines with the same x.
struct Area
{
    std::string name;
    std::vector<Point> upper;
    std::vector<double> lower; ///< as many as upper
    Colour fill;
    bool listed = true; ///< in the legend
};

/// Vertical lines from the base to the points.
struct Stems
{
    std::string name;
    std::vector<Point> points;
    double base = 0.0;
    Stroke stroke;
    Marker marker;      ///< at the points
    bool listed = true; ///< in the legend
};

using Series = std::variant<Line, Area, Stems>;

[[nodiscard]] inline bool isListed(const Series& series)
{
    return std::visit([](const auto& s) { return s.listed && !s.name.empty(); }, series);
}

[[nodiscard]] inline const std::string& nameOf(const Series& series)
{
    return std::visit([](const auto& s) -> const std::string& { return s.name; }, series);
}

} // namespace pacini::plot
