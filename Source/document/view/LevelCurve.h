#pragma once

// Level of a clip over time, for small pictures of it.

#include <pacini/clip/Clip.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace pacini
{

/// The power sum of the amplitudes of all bands and their noise, at all of their breakpoints.
[[nodiscard]] inline Curve bandLevels(const Clip& clip)
{
    std::vector<const Curve*> curves;
    std::vector<double> times;
    const auto add = [&](const Curve& curve)
    {
        if (curve.empty())
            return;
        curves.push_back(&curve);
        for (const Breakpoint& point : curve)
            times.push_back(point.time);
    };
    for (const Band& band : clip.bands)
        add(band.amplitude);
    for (const NoiseBand& band : clip.noise)
        add(band.amplitude);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    Curve sum;
    for (const double time : times)
        sum.push_back({time, 0.0});
    for (const Curve* curve : curves)
    {
        std::size_t next = 0; // point of the curve that is not before
        for (Breakpoint& point : sum)
        {
            while (next < curve->size() && (*curve)[next].time < point.time)
                ++next;
            double value = next < curve->size() ? (*curve)[next].value : curve->back().value;
            if (next > 0 && next < curve->size() && (*curve)[next].time > point.time)
            {
                const Breakpoint &a = (*curve)[next - 1], &b = (*curve)[next];
                value = a.value + (b.value - a.value) * (point.time - a.time) / (b.time - a.time);
            }
            point.value += value * value;
        }
    }
    for (Breakpoint& point : sum)
        point.value = std::sqrt(point.value);
    return sum;
}

/// Caches the curves of existing clips.
class LevelCurves
{
public:
    /// The envelope, or of a clip without one bandLevels(). Valid until the next call.
    [[nodiscard]] const Curve& of(const std::shared_ptr<const Clip>& clip)
    {
        if (!clip->envelope.empty())
            return clip->envelope;
        auto& [owner, levels] = kept[clip.get()];
        if (owner.lock() != clip)
        {
            std::erase_if(kept, [&](const auto& one) { return one.first != clip.get() && one.second.first.expired(); });
            owner = clip;
            levels = bandLevels(*clip);
        }
        return levels;
    }

private:
    std::map<const Clip*, std::pair<std::weak_ptr<const Clip>, Curve>> kept;
};

} // namespace pacini
