#pragma once

// Quantised curves: breakpoints on the grids of time and value, in whole numbers.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace pacini
{

/// A breakpoint on the grids: its tick and the code of its value.
struct GridPoint
{
    std::int64_t tick = 0;
    std::int64_t code = 0;
    bool operator==(const GridPoint&) const = default;
};

/// Quantised breakpoints in non-decreasing time.
using GridCurve = std::vector<GridPoint>;

/// The largest step that divides all ticks of a curve, at least 1.
[[nodiscard]] inline std::int64_t tickStride(const GridCurve& curve)
{
    std::int64_t stride = 0;
    for (const GridPoint& point : curve)
        stride = std::gcd(stride, point.tick);
    return std::max<std::int64_t>(stride, 1);
}

/// Reads a grid curve at ticks that only grow, in whole numbers only: writer and reader of a file must agree to the
/// last bit on every machine, which floating point does not promise. Does not own the curve, which may be missing.
class GridCurveReader
{
public:
    explicit GridCurveReader(const GridCurve* curveToRead) : curve(curveToRead) {}

    /// The linearly interpolated code; `otherwise` for a missing or empty curve.
    [[nodiscard]] std::int64_t at(std::int64_t tick, std::int64_t otherwise)
    {
        if (curve == nullptr || curve->empty())
            return otherwise;
        advance(tick);
        if (next == 0)
            return curve->front().code;
        if (next == curve->size())
            return curve->back().code;
        const GridPoint& a = (*curve)[next - 1];
        const GridPoint& b = (*curve)[next];
        return a.code + (b.code - a.code) * (tick - a.tick) / (b.tick - a.tick);
    }

    /// 2 with a point at `tick`, 1 with one at most `reach` away, else 0.
    [[nodiscard]] std::size_t nearness(std::int64_t tick, std::int64_t reach)
    {
        if (curve == nullptr)
            return 0;
        advance(tick);
        if (next > 0 && (*curve)[next - 1].tick == tick)
            return 2;
        if (next > 0 && tick - (*curve)[next - 1].tick <= reach)
            return 1;
        return next < curve->size() && (*curve)[next].tick - tick <= reach ? 1 : 0;
    }

private:
    void advance(std::int64_t tick)
    {
        while (next < curve->size() && (*curve)[next].tick <= tick)
            ++next;
    }

    const GridCurve* curve;
    std::size_t next = 0;
};

} // namespace pacini
