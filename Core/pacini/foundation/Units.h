#pragma once

// Physical units as 8-byte types with explicit constructors, so that a number never changes its unit silently.

#include <cmath>
#include <compare>

namespace pacini
{

/// A frequency in hertz.
struct Hertz
{
    double value{};

    constexpr Hertz() = default;
    constexpr explicit Hertz(double hertz) : value(hertz) {}
    constexpr auto operator<=>(const Hertz&) const = default; // NOLINT(modernize-use-nullptr): none is meant
};

/// A duration or a point of time in seconds.
struct Seconds
{
    double value{};

    constexpr Seconds() = default;
    constexpr explicit Seconds(double seconds) : value(seconds) {}
    constexpr auto operator<=>(const Seconds&) const = default; // NOLINT(modernize-use-nullptr): none is meant

    /// The duration as a number of frames at `fs` hertz, not rounded.
    [[nodiscard]] constexpr double frames(double fs) const noexcept { return value * fs; }
};

/// A level ratio in decibels: 20 log10 of amplitudes, 10 log10 of powers.
struct Decibels
{
    double value{};

    constexpr Decibels() = default;
    constexpr explicit Decibels(double decibels) : value(decibels) {}
    constexpr auto operator<=>(const Decibels&) const = default; // NOLINT(modernize-use-nullptr): none is meant

    /// The amplitude ratio, 1 at 0 dB.
    [[nodiscard]] double gain() const noexcept { return std::pow(10.0, value / 20.0); }

    /// The level of an amplitude ratio; minus infinity for 0.
    [[nodiscard]] static Decibels fromGain(double gain) noexcept { return Decibels(20.0 * std::log10(gain)); }

    /// The same for powers.
    [[nodiscard]] double power() const noexcept { return std::pow(10.0, value / 10.0); }
    [[nodiscard]] static Decibels fromPower(double power) noexcept { return Decibels(10.0 * std::log10(power)); }
};

inline namespace literals
{
constexpr Hertz operator""_Hz(long double v)
{
    return Hertz(static_cast<double>(v));
}
constexpr Hertz operator""_Hz(unsigned long long v)
{
    return Hertz(static_cast<double>(v));
}
constexpr Hertz operator""_kHz(long double v)
{
    return Hertz(static_cast<double>(v) * 1e3);
}
constexpr Hertz operator""_kHz(unsigned long long v)
{
    return Hertz(static_cast<double>(v) * 1e3);
}
constexpr Seconds operator""_s(long double v)
{
    return Seconds(static_cast<double>(v));
}
constexpr Seconds operator""_s(unsigned long long v)
{
    return Seconds(static_cast<double>(v));
}
constexpr Seconds operator""_ms(long double v)
{
    return Seconds(static_cast<double>(v) / 1e3);
}
constexpr Seconds operator""_ms(unsigned long long v)
{
    return Seconds(static_cast<double>(v) / 1e3);
}
constexpr Decibels operator""_dB(long double v)
{
    return Decibels(static_cast<double>(v));
}
constexpr Decibels operator""_dB(unsigned long long v)
{
    return Decibels(static_cast<double>(v));
}
} // namespace literals

inline constexpr double standardGravity = 9.80665; ///< m/s^2

} // namespace pacini
