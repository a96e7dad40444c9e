#include "io/formats/ahap/SumLimit.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pacini
{

namespace
{
/// The sum of all bands at a time, on both sides of steps there.
struct SumPoint
{
    double time = 0.0;
    double before = 0.0;
    double after = 0.0;
};

/// A band's amplitude on both sides of times that only move forward.
class BandLevel
{
public:
    explicit BandLevel(const Curve& curveToRead) : curve(curveToRead) {}

    /// Moves on to `time`; before and after are then its values there, and `own` says whether it has a point.
    void moveTo(double time)
    {
        while (next < curve.size() && curve[next].time < time)
            ++next;
        const std::size_t first = next;
        while (next < curve.size() && curve[next].time == time)
            ++next;
        own = next > first;
        if (own)
        {
            before = curve[first].value;
            after = curve[next - 1].value;
        }
        else if (!curve.empty())
        {
            const Breakpoint& a = curve[next > 0 ? next - 1 : 0];
            const Breakpoint& b = curve[std::min(next, curve.size() - 1)];
            const double place = b.time > a.time ? (time - a.time) / (b.time - a.time) : 0.0;
            before = after = a.value + (b.value - a.value) * place;
        }
    }

    double before = 0.0, after = 0.0;
    bool own = false;

private:
    const Curve& curve;
    std::size_t next = 0;
};

/// At the times of all points, and where the sum passes `most` between two.
std::vector<SumPoint> sumOf(const std::vector<Band>& bands, double most)
{
    std::vector<double> times;
    for (const Band& band : bands)
        for (const Breakpoint& point : band.amplitude)
            times.push_back(point.time);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    std::vector<BandLevel> levels;
    for (const Band& band : bands)
        levels.emplace_back(band.amplitude);
    std::vector<SumPoint> sums;
    for (const double time : times)
    {
        SumPoint sum{time, 0.0, 0.0};
        for (BandLevel& level : levels)
        {
            level.moveTo(time);
            sum.before += level.before;
            sum.after += level.after;
        }
        if (!sums.empty() && (sums.back().after - most) * (sum.before - most) < 0.0)
        {
            const SumPoint& last = sums.back();
            const double at = last.time + (time - last.time) * ((most - last.after) / (sum.before - last.after));
            if (at > last.time && at < time)
                sums.push_back({at, most, most});
        }
        sums.push_back(sum);
    }
    return sums;
}
} // namespace

Result<bool> limitSum(std::vector<Band>& bands, double most, std::size_t maxPoints)
{
    constexpr double rounding = 1.0 + 1e-6;
    if (bands.size() < 2)
        return false;
    const std::vector<SumPoint> sums = sumOf(bands, most);
    if (std::all_of(sums.begin(), sums.end(),
                    [&](const SumPoint& sum) { return std::max(sum.before, sum.after) <= most * rounding; }))
        return false;
    std::size_t count = 0;
    for (Band& band : bands)
    {
        BandLevel level(band.amplitude);
        Curve limited;
        for (const SumPoint& sum : sums)
        {
            level.moveTo(sum.time);
            const bool loud = std::max(sum.before, sum.after) >= most && std::max(level.before, level.after) > 0.0;
            if (!level.own && !loud)
                continue;
            const Breakpoint first{sum.time, level.before * most / std::max(sum.before, most)};
            const Breakpoint second{sum.time, level.after * most / std::max(sum.after, most)};
            limited.push_back(first);
            if (second.value != first.value)
                limited.push_back(second);
            count += 2;
        }
        if (count > maxPoints)
            return Error{ErrorCode::tooLarge, "", "too many points needed to stay within full drive"};
        band.amplitude = std::move(limited);
    }
    return true;
}

} // namespace pacini
