#pragma once

// Hat functions (linear interpolation basis): places of points between the vertices of a curve, with separate sides of
// a step.

#include <pacini/clip/Curve.h>

#include <cstddef>
#include <span>

namespace pacini
{

/// A place between two neighbouring vertices: value = (1 - fraction) v[left] + fraction v[left + 1]. At a vertex, and
/// outside the curve, the fraction is 0.
struct HatPlace
{
    std::size_t left = 0;
    double fraction = 0.0;

    [[nodiscard]] double of(std::span<const Breakpoint> vertices) const noexcept
    {
        const double value = vertices[left].value;
        return fraction == 0.0 ? value : value + fraction * (vertices[left + 1].value - value);
    }
};

/// Finds places at times that do not go back, O(1) per call on average. Does not own the curve, which has a point at
/// least.
class HatReader
{
public:
    explicit HatReader(std::span<const Breakpoint> curve) noexcept : vertices(curve) {}

    /// The place just before `time`: at a step its first vertex.
    [[nodiscard]] HatPlace before(double time) noexcept
    {
        while (notBefore < vertices.size() && vertices[notBefore].time < time)
            ++notBefore;
        if (notBefore == vertices.size())
            return {vertices.size() - 1, 0.0};
        if (notBefore == 0 || vertices[notBefore].time == time)
            return {notBefore, 0.0};
        return between(notBefore - 1, time);
    }

    /// The place at and just after `time`: at a step its last vertex (as valueAt reads it).
    [[nodiscard]] HatPlace after(double time) noexcept
    {
        while (later < vertices.size() && vertices[later].time <= time)
            ++later;
        if (later == 0)
            return {0, 0.0};
        if (later == vertices.size())
            return {later - 1, 0.0};
        return between(later - 1, time);
    }

private:
    [[nodiscard]] HatPlace between(std::size_t left, double time) const noexcept
    {
        const double start = vertices[left].time;
        return {left, (time - start) / (vertices[left + 1].time - start)};
    }

    std::span<const Breakpoint> vertices;
    std::size_t notBefore = 0; ///< first vertex at or after the last time asked for
    std::size_t later = 0;     ///< first vertex after it
};

/// Calls use(m, place) for each point m of `dense` with its place among `vertices` (one at least). Where several dense
/// points share one time, the first stands for the curve before the step and the last for the curve after it; those
/// in between last no time and are passed over. `dense` is a span, or what is indexed like one.
template <typename Dense, typename Use>
void forEachPlace(const Dense& dense, std::span<const Breakpoint> vertices, Use use)
{
    HatReader reader(vertices);
    for (std::size_t m = 0; m < dense.size(); ++m)
    {
        const bool stepBefore = m > 0 && dense[m - 1].time == dense[m].time;
        const bool stepAfter = m + 1 < dense.size() && dense[m + 1].time == dense[m].time;
        if (!stepBefore)
            use(m, stepAfter ? reader.before(dense[m].time) : reader.after(dense[m].time));
        else if (!stepAfter)
            use(m, reader.after(dense[m].time));
    }
}

} // namespace pacini
