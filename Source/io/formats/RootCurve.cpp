#include "io/formats/RootCurve.h"

#include "io/formats/LossList.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pacini
{

namespace
{
/// Cuts the curve into pieces whose roots differ by at most twice the root of the tolerance: between the ends r0 and r1
/// of a line, the square of the mean root is off by (r1 - r0)^2 / 4.
template <typename ToRoot, typename FromRoot>
Curve bent(const Curve& curve, ToRoot toRoot, FromRoot fromRoot)
{
    const double longest = 2.0 * std::sqrt(leastAmplitude) * (1.0 + 1e-6);
    Curve result;
    for (std::size_t i = 0; i < curve.size(); ++i)
    {
        if (i > 0 && curve[i].time > curve[i - 1].time)
        {
            const double r0 = toRoot(curve[i - 1].value), r1 = toRoot(curve[i].value);
            const auto pieces = std::ceil(std::abs(r1 - r0) / longest);
            for (double k = 1.0; k < pieces; k += 1.0)
            {
                // The place on the line of the curve where the root is r.
                const double r = r0 + (r1 - r0) * k / pieces;
                const auto [at, value] = fromRoot(r, curve[i - 1], curve[i]);
                result.push_back({at, value});
            }
        }
        result.push_back({curve[i].time, fromRoot(toRoot(curve[i].value), curve[i], curve[i]).value});
    }
    return result;
}
} // namespace

Curve rootOf(const Curve& amplitude)
{
    return bent(
        amplitude, [](double a) { return std::sqrt(std::max(a, 0.0)); },
        [](double r, const Breakpoint& from, const Breakpoint& to)
        {
            const double rise = to.value - from.value;
            const double place = rise != 0.0 ? std::clamp((r * r - from.value) / rise, 0.0, 1.0) : 0.0;
            return Breakpoint{from.time + place * (to.time - from.time), r};
        });
}

Curve squareOf(const Curve& level)
{
    return bent(
        level, [](double r) { return r; },
        [](double r, const Breakpoint& from, const Breakpoint& to)
        {
            const double rise = to.value - from.value;
            const double place = rise != 0.0 ? std::clamp((r - from.value) / rise, 0.0, 1.0) : 0.0;
            return Breakpoint{from.time + place * (to.time - from.time), r * r};
        });
}

} // namespace pacini
