// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Gain ramp: linear, sample by sample.

namespace pacini::plugin
{

/// Gain that moves to its target in a straight line, sample by sample, so that blocks leave no trace in it.
class GainRamp
{
public:
    void prepare(double sampleRate) noexcept { step = static_cast<float>(1.0 / (0.010 * sampleRate)); }
    void jump(float value) noexcept { now = target = value; }
    void aim(float value) noexcept { target = value; }
    [[nodiscard]] bool atRest() const noexcept { return now == target; }
    [[nodiscard]] float value() const noexcept { return now; }

    float next() noexcept
    {
        if (now < target)
            now = now + step < target ? now + step : target;
        else if (now > target)
            now = now - step > target ? now - step : target;
        return now;
    }

private:
    float now = 0.0f, target = 0.0f, step = 1.0f;
};

} // namespace pacini::plugin
