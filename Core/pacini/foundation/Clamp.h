#pragma once

// Clamping that is safe against NaN, for parameters of designs.

namespace pacini
{

/// `value` limited to [low, high]; NaN becomes `low`. std::clamp would let NaN through into a design.
template <typename T>
[[nodiscard]] constexpr T clampTo(T value, T low, T high) noexcept
{
    return value > low ? (value < high ? value : high) : low;
}

} // namespace pacini
