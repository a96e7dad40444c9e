#pragma once

// The grid on which the translator decides, and gains that move in straight lines from one decision to the next.

#include <cmath>
#include <cstddef>

namespace pacini
{

inline constexpr std::size_t controlHop = 8; ///< inner frames, 0.7 to 1.3 ms

/// A number that runs in straight lines between the points of the grid.
class HopRamp
{
public:
    /// To `target` at once.
    void jump(double target) noexcept
    {
        now = goal = target;
        step = 0.0;
    }

    /// At the start of a hop: goes the part `share` (0 to 1) of the way to `target` until its end. The last millionth
    /// is jumped, so that a gain arrives.
    void aim(double target, double share) noexcept
    {
        now = goal;
        goal = std::abs(target - now) <= 1e-6 ? target : now + share * (target - now);
        step = (goal - now) / static_cast<double>(controlHop);
    }

    [[nodiscard]] double next() noexcept { return now += step; }
    void skip(std::size_t frames) noexcept { now += static_cast<double>(frames) * step; }
    [[nodiscard]] double value() const noexcept { return now; }
    [[nodiscard]] double end() const noexcept { return goal; }
    [[nodiscard]] double perFrame() const noexcept { return step; }

    /// Whether it is 0 during the whole hop.
    [[nodiscard]] bool silent() const noexcept { return now == 0.0 && step == 0.0; }

private:
    double now = 0.0;
    double goal = 0.0;
    double step = 0.0;
};

/// The share of the way that a one-pole with the time constant `seconds` goes in one hop at `fs` Hz; 1 for 0 s.
[[nodiscard]] inline double hopShare(double seconds, double fs) noexcept
{
    return seconds > 0.0 ? -std::expm1(-static_cast<double>(controlHop) / (seconds * fs)) : 1.0;
}

} // namespace pacini
