#pragma once

// Noise estimate and drop-out detection on a measured curve.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pacini::detail
{

/// The standard deviation of noise on a smooth curve of at least 4 points: that of its third differences, which is
/// sqrt(20) times as large, from the median of their magnitudes, which drop-outs do not move (difference-based
/// estimation: P. Hall, J. W. Kay, D. M. Titterington, "Asymptotically optimal difference-based estimation of variance
/// in nonparametric regression", 1990; median: F. R. Hampel, "The influence curve and its role in robust estimation",
/// 1974).
[[nodiscard]] inline double noiseOf(const std::vector<double>& level)
{
    constexpr double medianToDeviation = 1.4826; // of a normal distribution
    std::vector<double> sizes;
    for (std::size_t i = 3; i < level.size(); ++i)
        sizes.push_back(std::abs((level[i] - level[i - 3]) - 3.0 * (level[i - 1] - level[i - 2])));
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return medianToDeviation * *middle / std::sqrt(20.0);
}

/// Marks runs of up to four points that jump away from the one before them and then come back to it, all by more than 6
/// dB and five times the noise. A resonance wide enough for its points to show it (see the largest q of a fit) changes
/// by less than 5 dB from one to the next; where there are fewer than 64 points it may be narrower, so that more is
/// asked there in proportion.
[[nodiscard]] inline std::vector<bool> dropoutsOf(const std::vector<double>& level, double noise)
{
    constexpr std::size_t longest = 4;
    const std::size_t n = level.size();
    const double threshold = 6.0 * std::max(1.0, 64.0 / static_cast<double>(n)) + 5.0 * noise; // dB
    std::vector<bool> dropouts(n, false);
    const auto scan = [&](const auto& index)
    {
        const auto apart = [&](std::size_t i, std::size_t j)
        {
            return std::abs(level[index(j)] - level[index(i)]) > threshold;
        };
        for (std::size_t i = 0; i + 1 < n;)
        {
            std::size_t end = i + 1;
            while (end < n && end <= i + longest && apart(i, end))
                ++end;
            if (end == n || !apart(i, end))
                for (std::size_t j = i + 1; j < end; ++j)
                    dropouts[index(j)] = true;
            i = end > i + longest ? i + 1 : end;
        }
    };
    // A run at the very start has no point before it: the other direction finds it.
    bool startsApart = false;
    for (std::size_t i = 1; i <= longest && i < n; ++i)
        startsApart = startsApart || std::abs(level[i] - level[0]) > threshold;
    if (startsApart)
        scan([n](std::size_t i) { return n - 1 - i; });
    else
        scan([](std::size_t i) { return i; });
    return dropouts;
}

} // namespace pacini::detail
