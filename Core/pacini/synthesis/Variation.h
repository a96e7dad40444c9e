#pragma once

// Random variation: the same clip, never quite the same.

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cstdint>

namespace pacini
{

/// Scope of the variation.
enum class VariationScope
{
    breakpoint, ///< every breakpoint of a band's amplitude gets its own factor
    band        ///< one factor for a whole band: like striking an object at another place
};

/// Amount and seed of random variation.
struct VariationParams
{
    double amount = 0.0; ///< 0 (none) to 1
    VariationScope scope = VariationScope::breakpoint;
    std::uint64_t seed = 0;
    bool operator==(const VariationParams&) const = default;
};

/// Scales band amplitudes by random factors drawn uniformly from [1 - amount, 1 + amount] (after Weber 2020, Eq. 4.14,
/// which draws from [0, amount]; read literally, no variation would be silence). `amount` is clamped to [0, 1]; the
/// same seed gives the same clip on every machine. Envelope, pitches and transients stay, so that timing and loudness
/// do.
[[nodiscard]] inline Clip vary(Clip clip, const VariationParams& params)
{
    const double amount = std::clamp(params.amount, 0.0, 1.0);
    if (amount == 0.0)
        return clip;
    Random random(params.seed);
    for (Band& band : clip.bands)
    {
        double factor = random.uniform(1.0 - amount, 1.0 + amount);
        for (Breakpoint& point : band.amplitude)
        {
            if (params.scope == VariationScope::breakpoint)
                factor = random.uniform(1.0 - amount, 1.0 + amount);
            point.value *= factor;
        }
    }
    return clip;
}

} // namespace pacini
