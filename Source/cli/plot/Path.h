#pragma once

// Points, rectangles and paths on a canvas: pixels from the upper left corner.

#include <cstddef>
#include <vector>

namespace pacini::plot
{

struct Point
{
    double x = 0.0, y = 0.0;
    bool operator==(const Point&) const = default;
};

struct Rectangle
{
    double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;

    [[nodiscard]] double width() const noexcept { return right - left; }
    [[nodiscard]] double height() const noexcept { return bottom - top; }

    [[nodiscard]] bool overlaps(const Rectangle& other) const noexcept
    {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
    [[nodiscard]] bool contains(const Rectangle& other) const noexcept
    {
        return left <= other.left && other.right <= right && top <= other.top && other.bottom <= bottom;
    }
    bool operator==(const Rectangle&) const = default;
};

/// Straight lines, possibly in several pieces.
class Path
{
public:
    enum class Verb
    {
        move,
        line,
        close,
    };

    struct Step
    {
        Verb verb = Verb::move;
        Point to; ///< unused by close
    };

    void moveTo(Point to) { steps.push_back({Verb::move, to}); }
    void lineTo(Point to) { steps.push_back({Verb::line, to}); }
    void close() { steps.push_back({Verb::close, {}}); }

    /// One stretch of a line by itself.
    void segment(Point from, Point to)
    {
        moveTo(from);
        lineTo(to);
    }

    /// A closed piece through `points`.
    void polygon(const std::vector<Point>& points)
    {
        open(points);
        close();
    }

    /// An open piece through `points`.
    void open(const std::vector<Point>& points)
    {
        for (std::size_t i = 0; i < points.size(); ++i)
            i == 0 ? moveTo(points[i]) : lineTo(points[i]);
    }

    void rectangle(const Rectangle& r)
    {
        polygon({{r.left, r.top}, {r.right, r.top}, {r.right, r.bottom}, {r.left, r.bottom}});
    }

    [[nodiscard]] bool empty() const noexcept { return steps.empty(); }
    [[nodiscard]] const std::vector<Step>& all() const noexcept { return steps; }

private:
    std::vector<Step> steps;
};

} // namespace pacini::plot
