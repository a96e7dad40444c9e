// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Panorama of a sound: its position between two channels.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace pacini::plugin
{

/// The position, 0 (left) to 1 (right), at which a constant-power panner would have put a sound with the powers of the
/// two channels, over 20 ms. Silence leaves it where it was; before any sound it is the middle.
class Panorama
{
public:
    void prepare(double sampleRate) noexcept { share = -std::expm1(-1.0 / (0.020 * sampleRate)); }
    void reset() noexcept
    {
        powers[0] = powers[1] = 0.0;
        place = 0.5;
    }

    /// Both of one length. [audio]
    void process(std::span<const float> left, std::span<const float> right) noexcept
    {
        double l = powers[0], r = powers[1];
        for (std::size_t i = 0; i < left.size(); ++i)
        {
            l += share * (static_cast<double>(left[i]) * static_cast<double>(left[i]) - l);
            r += share * (static_cast<double>(right[i]) * static_cast<double>(right[i]) - r);
        }
        // What is not finite would stay for ever; what is tiny, slow.
        powers[0] = std::isfinite(l) && l > 1e-30 ? l : 0.0;
        powers[1] = std::isfinite(r) && r > 1e-30 ? r : 0.0;
    }

    [[nodiscard]] double position() noexcept
    {
        constexpr double silence = 1e-10; // -100 dB
        if (powers[0] + powers[1] > silence)
            place = std::atan2(std::sqrt(powers[1]), std::sqrt(powers[0])) * 2.0 / std::numbers::pi;
        return place;
    }

private:
    double share = 0.001;
    double powers[2] = {};
    double place = 0.5;
};

} // namespace pacini::plugin
