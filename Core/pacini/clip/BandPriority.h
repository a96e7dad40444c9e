#pragma once

// Band priorities, for choosing bands if not all can be played.

#include <pacini/clip/Clip.h>
#include <pacini/clip/Curve.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace pacini
{

/// Integral of the squared amplitude over 0..duration (exact for straight pieces), in amplitude^2 seconds.
[[nodiscard]] inline double curveEnergy(std::span<const Breakpoint> curve, double duration)
{
    if (curve.empty())
        return 0.0;
    double energy = curve.front().value * curve.front().value * curve.front().time;
    for (std::size_t i = 1; i < curve.size(); ++i)
    {
        const double a = curve[i - 1].value;
        const double b = curve[i].value;
        energy += (a * a + a * b + b * b) / 3.0 * (curve[i].time - curve[i - 1].time);
    }
    return energy + curve.back().value * curve.back().value * (duration - curve.back().time);
}

/// Rank of each band by energy: 0 for the strongest; equal ones keep their order.
[[nodiscard]] inline std::vector<int> prioritiesByEnergy(std::span<const double> energies)
{
    std::vector<std::size_t> order(energies.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return energies[a] > energies[b]; });
    std::vector<int> priorities(energies.size());
    for (std::size_t rank = 0; rank < order.size(); ++rank)
        priorities[order[rank]] = static_cast<int>(rank);
    return priorities;
}

/// Gives the bands of `clip` the ranks of their energies.
inline void rankByEnergy(Clip& clip)
{
    std::vector<double> energies;
    for (const Band& band : clip.bands)
        energies.push_back(curveEnergy(band.amplitude, clip.duration));
    const auto priorities = prioritiesByEnergy(energies);
    for (std::size_t k = 0; k < clip.bands.size(); ++k)
        clip.bands[k].priority = priorities[k];
}

} // namespace pacini
