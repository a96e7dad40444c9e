#pragma once

// Noise gate: silences what is not meant to be felt.

#include <algorithm>
#include <cstddef>

namespace pacini
{

/// Noise gate. Opens at once when the level passes the threshold (the jump is as small as the threshold), stays open
/// while the level is above half of it or was so during the release, and closes in a straight line over another
/// release.
class LiveGate
{
public:
    /// `threshold` linear, `releaseFrames` at least 1.
    void setParams(double threshold, double releaseFrames) noexcept
    {
        limit = threshold;
        fall = 1.0 / releaseFrames;
        held = static_cast<std::size_t>(releaseFrames);
    }
    void reset() noexcept
    {
        gain = 0.0;
        left = 0;
    }

    [[nodiscard]] double tick(double level) noexcept
    {
        if (level >= limit || (left > 0 && level >= 0.5 * limit))
        {
            left = held;
            gain = 1.0;
        }
        else if (left > 0)
            --left;
        else
            gain = std::max(0.0, gain - fall);
        return gain;
    }

    [[nodiscard]] bool closed() const noexcept { return gain == 0.0; }

private:
    double limit = 0.0;
    double fall = 1.0;
    std::size_t held = 0;
    std::size_t left = 0;
    double gain = 0.0;
};

} // namespace pacini
