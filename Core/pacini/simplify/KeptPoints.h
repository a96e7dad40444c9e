#pragma once

// Result of a simplifier: the indices of the points of the dense curve that it keeps.

#include <pacini/clip/Curve.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace pacini
{

/// Ascending indices into a dense curve; the first and the last point are always among them.
using KeptPoints = std::vector<std::size_t>;

/// The indices 0..n-1.
[[nodiscard]] inline KeptPoints allPoints(std::size_t n)
{
    KeptPoints kept(n);
    std::iota(kept.begin(), kept.end(), std::size_t(0));
    return kept;
}

/// The curve made of the kept points of `dense`. Every index must be below dense.size().
[[nodiscard]] inline Curve curveOf(std::span<const Breakpoint> dense, std::span<const std::size_t> kept)
{
    Curve curve;
    curve.reserve(kept.size());
    for (const std::size_t i : kept)
        curve.push_back(dense[i]);
    return curve;
}

/// The path that ends at the last sample, where from[j] < j is the kept point before j; from[0] is not read.
inline void followBack(std::span<const std::uint32_t> from, KeptPoints& kept)
{
    kept.clear();
    for (std::size_t j = from.size() - 1; j != 0; j = from[j])
        kept.push_back(j);
    kept.push_back(0);
    std::reverse(kept.begin(), kept.end());
}

} // namespace pacini
