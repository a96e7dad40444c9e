// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Something to feel without any sound at hand.

#include <pacini/foundation/Random.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace pacini::app
{

/// Four seconds that repeat: a slow sweep over the range of touch, clicks, and rough noise that comes and goes.
class TestSignal
{
public:
    void prepare(double sampleRate) noexcept
    {
        fs = sampleRate;
        frame = 0;
        phase = 0.0;
    }

    [[nodiscard]] float next() noexcept
    {
        const double t = std::fmod(static_cast<double>(frame++) / fs, 4.0);
        const double frequency = 40.0 * std::exp2(2.5 * (0.5 - 0.5 * std::cos(0.5 * std::numbers::pi * t)));
        phase = std::fmod(phase + frequency / fs, 1.0);
        const double sweep = 0.35 * std::sin(2.0 * std::numbers::pi * phase);
        const double click = t > 1.0 && t < 3.0 ? 0.5 * std::exp(-150.0 * std::fmod(t, 0.2)) : 0.0;
        const double rough = 0.15 * std::max(0.0, std::sin(std::numbers::pi * (t - 2.0)));
        return static_cast<float>(sweep + (click + rough) * random.uniform(-1.0, 1.0));
    }

private:
    double fs = 48000.0;
    double phase = 0.0; // cycles
    std::uint64_t frame = 0;
    Random random{1};
};

} // namespace pacini::app
