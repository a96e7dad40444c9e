#pragma once

// Colour themes for a light and a dark ground, whose colours stay apart for colour-blind eyes.

#include "cli/plot/Colour.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace pacini::plot
{

/// Colours of a picture on a light or a dark ground.
struct Theme
{
    Colour ground;
    Colour text;
    Colour quietText;
    Colour frame;
    Colour grid;
    std::array<Colour, 7> palette; ///< for unordered things
    std::array<Colour, 5> ramp;    ///< for ordered things, equally spaced

    /// The i-th colour of the palette, which starts again at its end.
    [[nodiscard]] const Colour& series(std::size_t i) const noexcept { return palette[i % palette.size()]; }

    /// The colour at `position` (0 to 1, limited to that) of the ramp.
    [[nodiscard]] Colour ordered(double position) const noexcept
    {
        const double at = std::clamp(position, 0.0, 1.0) * static_cast<double>(ramp.size() - 1);
        const auto i = std::min(static_cast<std::size_t>(at), ramp.size() - 2);
        return mix(ramp[i], ramp[i + 1], at - static_cast<double>(i));
    }
};

/// The palette is that of Okabe and Ito ("Color Universal Design", 2008) without yellow, which vanishes on white; the
/// ramp is the part of viridis (van der Walt and Smith, 2015) that stands out from the ground.
[[nodiscard]] constexpr Theme lightTheme() noexcept
{
    constexpr auto hex = Colour::fromHex;
    return {hex(0xffffff),
            hex(0x1a1a1a),
            hex(0x5c5c5c),
            hex(0x8c8c8c),
            hex(0xe4e4e4),
            {hex(0x0072b2), hex(0xd55e00), hex(0x009e73), hex(0xcc79a7), hex(0xe69f00), hex(0x56b4e9), hex(0x000000)},
            {hex(0x46327e), hex(0x365c8d), hex(0x277f8e), hex(0x1fa187), hex(0x5ab83a)}};
}

/// The same on a dark ground: blue gives way to its lighter neighbour, black to white, the ramp moves up.
[[nodiscard]] constexpr Theme darkTheme() noexcept
{
    constexpr auto hex = Colour::fromHex;
    return {hex(0x15181c),
            hex(0xececec),
            hex(0xa3a8ae),
            hex(0x6a7078),
            hex(0x2b3037),
            {hex(0x56b4e9), hex(0xe8743b), hex(0x1fc79a), hex(0xdf9bc3), hex(0xe69f00), hex(0xf0e442), hex(0xffffff)},
            {hex(0x7f6fd0), hex(0x4f97d0), hex(0x2fb3a4), hex(0x5ecb66), hex(0xd9e219)}};
}

} // namespace pacini::plot
