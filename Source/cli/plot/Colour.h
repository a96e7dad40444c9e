#pragma once

// Colours: sRGB with opacity.

#include <cstdint>

namespace pacini::plot
{

/// An sRGB colour; all parts 0 to 1.
struct Colour
{
    double red = 0.0;
    double green = 0.0;
    double blue = 0.0;
    double alpha = 1.0;

    /// From 0xRRGGBB.
    [[nodiscard]] static constexpr Colour fromHex(std::uint32_t hex) noexcept
    {
        return {static_cast<double>(hex >> 16 & 0xffu) / 255.0, static_cast<double>(hex >> 8 & 0xffu) / 255.0,
                static_cast<double>(hex & 0xffu) / 255.0};
    }

    [[nodiscard]] constexpr Colour withAlpha(double opacity) const noexcept { return {red, green, blue, opacity}; }

    bool operator==(const Colour&) const = default;
};

/// `a` at 0, `b` at 1, in between a straight line in sRGB.
[[nodiscard]] constexpr Colour mix(const Colour& a, const Colour& b, double share) noexcept
{
    const auto part = [share](double x, double y)
    {
        return x + (y - x) * share;
    };
    return {part(a.red, b.red), part(a.green, b.green), part(a.blue, b.blue), part(a.alpha, b.alpha)};
}

} // namespace pacini::plot
