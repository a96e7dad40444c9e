#pragma once

// Colour map of levels, in steps that are equal for the eye.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace pacini
{

namespace detail
{
/// A colour in OKLab (B. Ottosson, "A perceptual color space for image processing", 2020).
struct OkLab
{
    double lightness = 0.0, a = 0.0, b = 0.0;
};

/// As 0xRRGGBB; what sRGB does not have is clamped.
inline std::uint32_t rgbOf(const OkLab& c) noexcept
{
    const double l = std::pow(c.lightness + 0.3963377774 * c.a + 0.2158037573 * c.b, 3.0);
    const double m = std::pow(c.lightness - 0.1055613458 * c.a - 0.0638541728 * c.b, 3.0);
    const double s = std::pow(c.lightness - 0.0894841775 * c.a - 1.2914855480 * c.b, 3.0);
    const auto byte = [](double linear)
    {
        const double x = std::clamp(linear, 0.0, 1.0);
        const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
        return static_cast<std::uint32_t>(std::lround(255.0 * encoded));
    };
    return byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s) << 16 |
           byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s) << 8 |
           byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s);
}
} // namespace detail

/// 256 colours from soft to loud, 0xRRGGBB, in equal steps for the eye: equal distances in OKLab, lightness always
/// rising on a dark ground and always falling on a light one.
[[nodiscard]] inline std::array<std::uint32_t, 256> levelColours(bool dark) noexcept
{
    using detail::OkLab;
    // Night blue, violet, rose, amber, pale yellow; and paper, sea green, blue, violet, near black.
    constexpr std::array<OkLab, 5> night{
        {{0.20, 0.0, -0.01}, {0.36, 0.02, -0.10}, {0.55, 0.13, -0.06}, {0.74, 0.09, 0.09}, {0.95, -0.01, 0.10}}};
    constexpr std::array<OkLab, 5> paper{
        {{0.92, -0.003, -0.005}, {0.76, -0.08, -0.01}, {0.57, -0.05, -0.09}, {0.38, 0.04, -0.14}, {0.18, 0.04, -0.04}}};
    const auto& path = dark ? night : paper;
    std::array<double, 5> length{};
    for (std::size_t i = 1; i < path.size(); ++i)
        length[i] = length[i - 1] + std::hypot(path[i].lightness - path[i - 1].lightness, path[i].a - path[i - 1].a,
                                               path[i].b - path[i - 1].b);
    std::array<std::uint32_t, 256> colours{};
    std::size_t piece = 0;
    for (std::size_t i = 0; i < colours.size(); ++i)
    {
        const double at = length.back() * static_cast<double>(i) / 255.0;
        while (piece + 2 < path.size() && at > length[piece + 1])
            ++piece;
        const double part = (at - length[piece]) / (length[piece + 1] - length[piece]);
        const OkLab &from = path[piece], &to = path[piece + 1];
        colours[i] = detail::rgbOf({from.lightness + part * (to.lightness - from.lightness),
                                    from.a + part * (to.a - from.a), from.b + part * (to.b - from.b)});
    }
    return colours;
}

} // namespace pacini
