#pragma once

// Gaussian random numbers that are the same on every machine with the same mathematical library.

#include <pacini/foundation/Random.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace pacini
{

/// A number of mean 0, standard deviation 1 from a normal distribution, by G. Box and M. Muller, "A note on the
/// generation of random normal deviates", 1958.
inline double normalNumber(Random& random) noexcept
{
    const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * random.uniform());
}

/// Gaussian random numbers from a seed.
class Gaussian
{
public:
    explicit Gaussian(std::uint64_t seed) noexcept : random(seed) {}

    double next() noexcept { return normalNumber(random); }

private:
    Random random;
};

} // namespace pacini
