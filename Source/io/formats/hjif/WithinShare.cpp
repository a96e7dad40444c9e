#include "io/formats/hjif/WithinShare.h"

#include <algorithm>
#include <limits>

namespace pacini
{

Curve withinShare(const Curve& curve, double share, double floor)
{
    if (curve.size() < 3)
        return curve;
    constexpr double any = std::numeric_limits<double>::infinity();
    Curve kept{curve.front()};
    // The last kept point is asked for anew each time: keeping one moves it.
    const auto slopeTo = [&kept](double value, const Breakpoint& point)
    {
        const Breakpoint& from = kept.back();
        return point.time > from.time ? (value - from.value) / (point.time - from.time) : any;
    };
    double least = -any, most = any;
    for (std::size_t i = 1; i < curve.size(); ++i)
    {
        const double slope = slopeTo(curve[i].value, curve[i]);
        if (curve[i].time <= kept.back().time || slope < least || slope > most)
        {
            if (!(kept.back() == curve[i - 1]))
                kept.push_back(curve[i - 1]);
            least = -any;
            most = any;
            if (curve[i].time <= kept.back().time)
            {
                kept.push_back(curve[i]);
                continue;
            }
        }
        const double tolerance = std::max(floor, share * curve[i].value);
        least = std::max(least, slopeTo(curve[i].value - tolerance, curve[i]));
        most = std::min(most, slopeTo(curve[i].value + tolerance, curve[i]));
    }
    if (!(kept.back() == curve.back()))
        kept.push_back(curve.back());
    return kept;
}

} // namespace pacini
