#pragma once

// How large a clip is by the thesis' count.

#include <pacini/clip/Clip.h>

#include <cstddef>

namespace pacini
{

/// The bits that a clip takes as the thesis counts (Weber 2020, Eq. 4.11): `bits` for each time and each value of all
/// breakpoints, and of the time and amplitude of all transients.
[[nodiscard]] inline std::size_t thesisBits(const Clip& clip, int bits) noexcept
{
    return (breakpointCount(clip) + clip.transients.size()) * 2 * static_cast<std::size_t>(bits);
}

} // namespace pacini
