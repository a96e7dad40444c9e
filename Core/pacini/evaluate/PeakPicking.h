#pragma once

// Peak picking: local maxima of a sampled curve.

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace pacini
{

/// Indices of the local maxima of x that are at least `height` high and at least `distance` samples apart, in order. Of
/// two that are closer, the higher one stays (of equal ones the later). A plateau counts once, at its middle (rounded
/// down); the first and the last sample are never maxima. Same rules as scipy.signal.find_peaks(x, height,
/// distance=...).
[[nodiscard]] inline std::vector<std::size_t> findPeaks(std::span<const double> x, double height, std::size_t distance)
{
    std::vector<std::size_t> peaks;
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
    {
        if (!(x[i - 1] < x[i]))
            continue;
        std::size_t end = i + 1;
        while (end + 1 < x.size() && x[end] == x[i])
            ++end;
        if (x[end] < x[i] && x[i] >= height)
            peaks.push_back((i + end - 1) / 2);
        i = end - 1;
    }

    std::vector<std::size_t> byHeight(peaks.size());
    std::iota(byHeight.begin(), byHeight.end(), std::size_t(0));
    std::stable_sort(byHeight.begin(), byHeight.end(),
                     [&](std::size_t a, std::size_t b) { return x[peaks[a]] < x[peaks[b]]; });
    std::vector<bool> keep(peaks.size(), true);
    for (std::size_t rank = byHeight.size(); rank-- > 0;)
    {
        const std::size_t strong = byHeight[rank];
        if (!keep[strong])
            continue;
        for (std::size_t i = strong; i-- > 0 && peaks[strong] - peaks[i] < distance;)
            keep[i] = false;
        for (std::size_t i = strong + 1; i < peaks.size() && peaks[i] - peaks[strong] < distance; ++i)
            keep[i] = false;
    }
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < peaks.size(); ++i)
        if (keep[i])
            kept.push_back(peaks[i]);
    return kept;
}

} // namespace pacini
