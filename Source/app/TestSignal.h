// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Test signal: a sweep, clicks and noise, for a first test without a sound.

#include <pacini/foundation/Random.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace pacini::app
{

/// A loop of six seconds: a sweep over the range of touch, clicks in silence, rough noise that fades in and out.
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
        const double t = std::fmod(static_cast<double>(frame++) / fs, 6.0);
        const double noise = random.uniform(-1.0, 1.0);
        if (t < 2.0)
        {
            phase = std::fmod(phase + 40.0 * std::exp2(2.0 * t) / fs, 1.0);
            return static_cast<float>(0.5 * std::sin(0.5 * std::numbers::pi * t) *
                                      std::sin(2.0 * std::numbers::pi * phase));
        }
        if (t < 4.0)
            return static_cast<float>(0.7 * std::exp(-120.0 * std::fmod(t, 0.2)) * noise);
        const double swell = std::sin(std::numbers::pi * (t - 4.0));
        return static_cast<float>(0.4 * swell * swell * noise);
    }

private:
    double fs = 48000.0;
    double phase = 0.0; // cycles
    std::uint64_t frame = 0;
    Random random{1};
};

} // namespace pacini::app
