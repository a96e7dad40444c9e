#pragma once

// Piecewise-linear curve reader: a curve over frames, one straight piece after the other.

#include <pacini/clip/Curve.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace pacini
{

/// A straight piece of a curve. Values follow from the frame alone, so that they do not depend on blocks.
struct CurvePiece
{
    double value = 0.0; // at `origin`
    double slope = 0.0; // per s
    double origin = 0.0;
    double fs = 1.0;
    [[nodiscard]] double at(std::int64_t frame) const noexcept
    {
        return value + slope * (static_cast<double>(frame) / fs - origin);
    }
};

/// Calls use(i, end, piece) for the straight pieces of a curve (not empty, over s) over frames [now, now + n). `next`
/// is the point that is reached next: 0 at first, then as the call before has left it. [audio]
template <typename Use>
void forCurvePieces(const Curve& curve, std::size_t& next, std::int64_t now, std::size_t n, double fs,
                    Use&& use) noexcept
{
    for (std::size_t i = 0; i < n;)
    {
        const double t = static_cast<double>(now + static_cast<std::int64_t>(i)) / fs;
        while (next < curve.size() && curve[next].time <= t)
            ++next;
        std::size_t end = n;
        if (next < curve.size())
        {
            const double until = std::ceil(curve[next].time * fs) - static_cast<double>(now);
            end = until < static_cast<double>(n) ? std::max(i + 1, static_cast<std::size_t>(until)) : n;
        }
        if (next == 0 || next == curve.size() || curve[next - 1].value == curve[next].value)
            use(i, end, CurvePiece{next == 0 ? curve.front().value : curve[next - 1].value, 0.0, 0.0, fs});
        else
        {
            const Breakpoint& a = curve[next - 1];
            const Breakpoint& b = curve[next];
            use(i, end, CurvePiece{a.value, (b.value - a.value) / (b.time - a.time), a.time, fs});
        }
        i = end;
    }
}

} // namespace pacini
