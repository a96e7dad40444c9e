#pragma once

// Largest magnitude of a signal.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace pacini
{

/// The largest |x|; 0 for none. What is not a number does not count. Eight side by side: one after the other each would
/// wait for the one before. [audio]
[[nodiscard]] inline float largestMagnitude(std::span<const float> samples) noexcept
{
    constexpr std::size_t lanes = 8;
    std::array<float, lanes> largest{};
    std::size_t i = 0;
    for (; i + lanes <= samples.size(); i += lanes)
        for (std::size_t k = 0; k < lanes; ++k)
            largest[k] = std::abs(samples[i + k]) > largest[k] ? std::abs(samples[i + k]) : largest[k];
    for (; i < samples.size(); ++i)
        largest[0] = std::abs(samples[i]) > largest[0] ? std::abs(samples[i]) : largest[0];
    return *std::max_element(largest.begin(), largest.end());
}

} // namespace pacini
