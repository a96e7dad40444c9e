#pragma once

// Seeded random numbers that are the same on every machine.

#include <cstdint>

namespace pacini
{

/// Pseudorandom numbers by SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014).
/// Chosen over <random> because the standard distributions differ between libraries.
class Random
{
public:
    explicit constexpr Random(std::uint64_t seed) noexcept : state(seed) {}

    constexpr std::uint64_t next() noexcept
    {
        state += 0x9E3779B97F4A7C15ull;
        std::uint64_t z = state;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
        return z ^ (z >> 31);
    }

    /// Uniform in [0, 1).
    constexpr double uniform() noexcept { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

    /// Uniform in [low, high).
    constexpr double uniform(double low, double high) noexcept { return low + (high - low) * uniform(); }

private:
    std::uint64_t state;
};

} // namespace pacini
