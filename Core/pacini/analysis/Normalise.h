#pragma once

// Peak normalisation.

#include <pacini/foundation/DspBlock.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace pacini
{

/// The largest |x|; 0 for an empty span; NaN and infinities count as 0.
[[nodiscard]] inline double peakOf(std::span<const float> signal) noexcept
{
    double peak = 0.0;
    for (const float x : signal)
        peak = std::max(peak, std::abs(finiteOrZero(x)));
    return peak;
}

/// Divides the signal by its peak, in place, and returns that peak. A signal that is silent or empty is left alone and
/// returns 0; NaN and infinities become 0.
inline double normalise(std::span<float> signal) noexcept
{
    const double peak = peakOf(signal);
    for (float& x : signal)
        x = peak > 0.0 ? toSample(finiteOrZero(x) / peak) : 0.0f;
    return peak;
}

} // namespace pacini
