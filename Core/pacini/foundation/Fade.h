#pragma once

// Fade: a gain that moves from one level to another without a corner.

#include <cstddef>

namespace pacini
{

/// Gain that approaches its target along 3 u^2 - 2 u^3, frame by frame and independent of block sizes; it reaches the
/// target exactly. A straight line has a corner at each end: for 10 ms, these are heard at -45 dB above 1.5 kHz. This
/// curve stays below -70 dB. A new target during a fade takes effect at its end, so that automation of any speed is a
/// sequence of such curves and never leaves the range of its targets.
class Fade
{
public:
    /// The length of a fade, 1 frame at least.
    void prepare(std::size_t fadeFrames) noexcept { frames = fadeFrames > 0 ? fadeFrames : 1; }

    void jump(double level) noexcept
    {
        now = from = goal = target = level;
        left = 0;
    }
    void aim(double level) noexcept { target = level; }

    [[nodiscard]] bool resting() const noexcept { return left == 0 && now == target; }
    [[nodiscard]] bool restsAt(double level) const noexcept { return resting() && now == level; }
    [[nodiscard]] double value() const noexcept { return now; }
    /// Frames until the fade that runs, or begins with the next frame, ends; 0 at rest.
    [[nodiscard]] std::size_t framesLeft() const noexcept { return left > 0 || now == target ? left : frames; }

    double next() noexcept
    {
        if (left == 0)
        {
            if (now == target)
                return now;
            from = now;
            goal = target;
            left = frames;
        }
        --left;
        const double u = 1.0 - static_cast<double>(left) / static_cast<double>(frames);
        now = left == 0 ? goal : from + (goal - from) * u * u * (3.0 - 2.0 * u);
        return now;
    }

private:
    double now = 0.0, from = 0.0, goal = 0.0, target = 0.0;
    std::size_t frames = 1;
    std::size_t left = 0;
};

} // namespace pacini
