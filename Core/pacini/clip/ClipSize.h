#pragma once

// How large a clip is by the thesis' count.

#include <pacini/clip/Clip.h>

#include <cstddef>

namespace pacini
{

/// Bit rate of an encoded sound (Weber 2020, Eq. 4.11): (bands * breakpoints per second * bits + transients per second
/// * bits) * 2 bit/s, the 2 for time and value. For (6, 20, 12, 2) this is 2928 bit/s = 366 B/s; the thesis prints
/// 5808, with the 2 applied twice to the bands.
[[nodiscard]] constexpr double thesisBitRate(double bands, double breakpointsPerSecond, double bits,
                                             double transientsPerSecond) noexcept
{
    return (bands * breakpointsPerSecond * bits + transientsPerSecond * bits) * 2.0;
}

/// The same count for what a clip really holds: `bits` for each time and each value of all breakpoints, and of
/// the time and amplitude of all transients.
[[nodiscard]] inline std::size_t thesisBits(const Clip& clip, int bits) noexcept
{
    return (breakpointCount(clip) + clip.transients.size()) * 2 * static_cast<std::size_t>(bits);
}

} // namespace pacini
