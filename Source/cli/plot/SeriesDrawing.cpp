#include "cli/plot/SeriesDrawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace pacini::plot
{

namespace
{
/// Adds the outline of a marker; crosses are open lines.
void addMarker(Path& path, const Marker& marker, Point at)
{
    const double r = 0.5 * marker.size;
    const auto corners = [&](std::size_t count, double firstAngle, double radius)
    {
        std::vector<Point> points;
        for (std::size_t i = 0; i < count; ++i)
        {
            const double angle =
                firstAngle + 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
            points.push_back({at.x + radius * std::cos(angle), at.y + radius * std::sin(angle)});
        }
        path.polygon(points);
    };
    constexpr double down = 0.5 * std::numbers::pi;
    switch (marker.shape)
    {
    case MarkerShape::circle:
        corners(16, 0.0, r);
        break;
    case MarkerShape::square:
        corners(4, 0.5 * down, 1.25 * r);
        break;
    case MarkerShape::diamond:
        corners(4, 0.0, 1.25 * r);
        break;
    case MarkerShape::triangle:
        corners(3, -down, 1.25 * r);
        break;
    case MarkerShape::triangleDown:
        corners(3, down, 1.25 * r);
        break;
    case MarkerShape::cross:
        path.segment({at.x - r, at.y - r}, {at.x + r, at.y + r});
        path.segment({at.x - r, at.y + r}, {at.x + r, at.y - r});
        break;
    case MarkerShape::plus:
        path.segment({at.x - 1.2 * r, at.y}, {at.x + 1.2 * r, at.y});
        path.segment({at.x, at.y - 1.2 * r}, {at.x, at.y + 1.2 * r});
        break;
    }
}

Paint markerPaint(const Marker& marker)
{
    const bool open = marker.shape == MarkerShape::cross || marker.shape == MarkerShape::plus;
    if (open)
        return {{}, Stroke{marker.colour, 0.25 * marker.size}};
    return {marker.colour, {}};
}

void drawMarker(Canvas& canvas, const Marker& marker, Point at)
{
    Path path;
    addMarker(path, marker, at);
    canvas.draw(path, markerPaint(marker));
}

/// More than one marker in 0.7 of its size would run together into a bar.
bool markersFit(const Marker& marker, std::size_t count, double width)
{
    return static_cast<double>(count) * 0.7 * marker.size <= width;
}

void drawMarkers(Canvas& canvas, const Marker& marker, std::span<const Point> pixels, const Rectangle& box)
{
    if (!markersFit(marker, pixels.size(), box.width()))
        return;
    Path path;
    if (marker.shape == MarkerShape::circle && marker.size <= 6.0)
    {
        for (const Point& at : pixels)
            path.segment(at, at); // a dot, see Stroke::round
        canvas.draw(path, {{}, Stroke{marker.colour, marker.size}});
        return;
    }
    for (const Point& at : pixels)
        addMarker(path, marker, at);
    canvas.draw(path, markerPaint(marker));
}

std::vector<Point> inPixels(const std::vector<Point>& points, const PlotArea& area)
{
    std::vector<Point> pixels;
    pixels.reserve(points.size());
    for (const Point& point : points)
        pixels.push_back(area.at(point));
    return pixels;
}

void drawIn(Canvas& canvas, const Line& line, const PlotArea& area)
{
    const auto pixels = inPixels(line.points, area);
    if (line.stroke && pixels.size() > 1)
    {
        Path path;
        path.open(thinned(pixels));
        canvas.draw(path, {{}, *line.stroke});
    }
    if (line.marker && !pixels.empty())
        drawMarkers(canvas, *line.marker, pixels, area.box);
}

void drawIn(Canvas& canvas, const Area& series, const PlotArea& area)
{
    std::vector<Point> lower;
    for (std::size_t i = 0; i < series.upper.size(); ++i)
        lower.push_back(area.at({series.upper[i].x, series.lower[i]}));
    auto outline = thinned(inPixels(series.upper, area));
    lower = thinned(lower);
    outline.insert(outline.end(), lower.rbegin(), lower.rend());
    if (outline.size() < 4)
        return;
    Path path;
    path.polygon(outline);
    canvas.draw(path, {series.fill, {}});
}

void drawIn(Canvas& canvas, const Stems& stems, const PlotArea& area)
{
    const auto pixels = inPixels(stems.points, area);
    if (pixels.empty())
        return;
    Path path;
    for (const Point& top : pixels)
        path.segment({top.x, area.atY(stems.base)}, top);
    Stroke stroke = stems.stroke;
    // Without their markers stems are told apart by what shines through.
    if (!markersFit(stems.marker, pixels.size(), area.box.width()))
        stroke.colour = stroke.colour.withAlpha(0.4);
    canvas.draw(path, {{}, stroke});
    drawMarkers(canvas, stems.marker, pixels, area.box);
}
} // namespace

std::vector<Point> thinned(const std::vector<Point>& points)
{
    if (!std::is_sorted(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; }))
        return points;
    std::vector<Point> kept;
    for (std::size_t i = 0; i < points.size();)
    {
        const double column = std::floor(points[i].x);
        std::size_t end = i;
        std::size_t lowest = i;
        std::size_t highest = i;
        for (; end < points.size() && std::floor(points[end].x) == column; ++end)
        {
            lowest = points[end].y < points[lowest].y ? end : lowest;
            highest = points[end].y > points[highest].y ? end : highest;
        }
        std::array<std::size_t, 4> order = {i, std::min(lowest, highest), std::max(lowest, highest), end - 1};
        for (std::size_t k = 0; k < order.size(); ++k)
            if (k == 0 || order[k] != order[k - 1])
                kept.push_back(points[order[k]]);
        i = end;
    }
    return kept;
}

bool isSeen(const Series& series, double width)
{
    const auto* line = std::get_if<Line>(&series);
    if (line == nullptr || line->stroke)
        return true;
    return !line->points.empty() && line->marker && markersFit(*line->marker, line->points.size(), width);
}

void drawSeries(Canvas& canvas, const Series& series, const PlotArea& area, const Look& look)
{
    // Lines and markers at the edge are cut in half there; a little room shows them whole.
    const double room = look.metrics.gap();
    canvas.beginGroup(nameOf(series), Rectangle{area.box.left - room, area.box.top - room, area.box.right + room,
                                                area.box.bottom + room});
    std::visit([&](const auto& s) { drawIn(canvas, s, area); }, series);
    canvas.endGroup();
}

void markTaken(const Series& series, const PlotArea& area, std::vector<Rectangle>& taken)
{
    const auto* line = std::get_if<Line>(&series);
    if (line == nullptr || !line->marker)
        return;
    const double r = 0.5 * line->marker->size;
    for (const Point& p : inPixels(line->points, area))
        taken.push_back({p.x - r, p.y - r, p.x + r, p.y + r});
}

void labelPoints(Canvas& canvas, const Line& line, const PlotArea& area, const Look& look,
                 std::vector<Rectangle>& taken)
{
    const auto pixels = inPixels(line.points, area);
    const TextStyle style{look.theme.text, 0.85 * look.metrics.text};
    const double away = (line.marker ? 0.5 * line.marker->size : 0.0) + 0.3 * style.size;
    for (std::size_t i = 0; i < std::min(line.labels.size(), pixels.size()); ++i)
    {
        if (line.labels[i].empty())
            continue;
        const double width = canvas.textWidth(line.labels[i], style);
        const Point p = pixels[i];
        const double rise = 0.36 * style.size; // from the baseline to the middle of a digit
        const std::array<Point, 6> places = {
            Point{p.x + away, p.y - 0.5 * away},    {p.x - 0.5 * width, p.y - away},
            {p.x + away, p.y + rise + away},        {p.x - 0.5 * width, p.y + away + 2.0 * rise},
            {p.x - away - width, p.y - 0.5 * away}, {p.x - away - width, p.y + rise + away}};
        for (const Point& place : places)
        {
            const Rectangle needed{place.x, place.y - 0.8 * style.size, place.x + width, place.y + 0.25 * style.size};
            const bool free = area.box.contains(needed) &&
                              std::none_of(taken.begin(), taken.end(),
                                           [&](const Rectangle& other) { return other.overlaps(needed); });
            if (!free)
                continue;
            canvas.text(place, line.labels[i], style);
            taken.push_back(needed);
            break;
        }
    }
}

void drawSample(Canvas& canvas, const Series& series, Point at, double width)
{
    Path path;
    path.segment({at.x - 0.5 * width, at.y}, {at.x + 0.5 * width, at.y});
    if (const auto* line = std::get_if<Line>(&series))
    {
        if (line->stroke)
            canvas.draw(path, {{}, *line->stroke});
        if (line->marker)
            drawMarker(canvas, *line->marker, at);
    }
    else if (const auto* stems = std::get_if<Stems>(&series))
    {
        drawMarker(canvas, stems->marker, at);
    }
    else if (const auto* area = std::get_if<Area>(&series))
    {
        Path box;
        const double half = 0.25 * width;
        box.rectangle({at.x - 2.0 * half, at.y - half, at.x + 2.0 * half, at.y + half});
        canvas.draw(box, {area->fill, {}});
    }
}

} // namespace pacini::plot
