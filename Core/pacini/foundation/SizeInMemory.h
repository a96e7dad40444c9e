#pragma once

// Conversion of counts to sizes in memory.

#include <concepts>
#include <cstddef>
#include <limits>
#include <utility>

namespace pacini
{

/// `count` as the size of a container. Positions and lengths in time have 64 bits on every machine, sizes need not.
/// Returns 0 for a negative count, and for one that does not fit the largest size, which every container refuses: a
/// cast would take a part of the count for all of it.
template <std::integral Count>
[[nodiscard]] constexpr std::size_t sizeInMemory(Count count) noexcept
{
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
    return std::cmp_less(count, 0) ? 0 : std::cmp_greater(count, most) ? most : static_cast<std::size_t>(count);
}

/// The same for a count that has been computed: rounded towards 0; NaN gives 0.
[[nodiscard]] constexpr std::size_t sizeInMemory(double count) noexcept
{
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
    constexpr double beyond = 2.0 * static_cast<double>(most / 2 + 1); // a power of two
    return !(count > 0.0) ? 0 : count >= beyond ? most : static_cast<std::size_t>(count);
}

} // namespace pacini
