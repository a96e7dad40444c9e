#pragma once

// Running median: values sorted while a window slides over them.

#include <cstddef>
#include <span>

namespace pacini
{

/// Puts `entering` in the place of one value equal to `leaving`, which must be there (a broken precondition), and keeps
/// `sorted` in ascending order. No value may be NaN. O(size), a few steps where neighbours are alike: for windows below
/// some hundred values faster than trees or heaps. [any]
inline void replaceSorted(std::span<float> sorted, float leaving, float entering) noexcept
{
    std::size_t low = 0;
    for (std::size_t high = sorted.size(); low < high;)
    {
        const std::size_t middle = (low + high) / 2;
        if (sorted[middle] < leaving)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low + 1 < sorted.size() && sorted[low + 1] < entering; ++low)
        sorted[low] = sorted[low + 1];
    for (; low > 0 && sorted[low - 1] > entering; --low)
        sorted[low] = sorted[low - 1];
    sorted[low] = entering;
}

/// The median of an odd number of values in order. [any]
[[nodiscard]] inline float medianOfSorted(std::span<const float> sorted) noexcept
{
    return sorted[sorted.size() / 2];
}

/// Returns the index of the value, of `size` (at least one), at `index` of their endless reflection about both ends, d
/// c b a | a b c d | d c b a: the continuation of windows beyond the ends. [any]
[[nodiscard]] constexpr std::size_t reflectedIndex(std::ptrdiff_t index, std::size_t size) noexcept
{
    const auto period = static_cast<std::ptrdiff_t>(2 * size);
    const std::ptrdiff_t within = ((index % period) + period) % period;
    return static_cast<std::size_t>(within < period / 2 ? within : period - 1 - within);
}

} // namespace pacini
