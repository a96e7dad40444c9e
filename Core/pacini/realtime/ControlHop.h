#pragma once

// Control rate of the translator: the grid on which it decides, and gain ramps from one decision to the next.

#include <cmath>
#include <cstddef>

namespace pacini
{

inline constexpr std::size_t controlHop = 8; ///< inner frames, 0.7 to 1.3 ms

/// Linear gain ramp: a number that runs in straight lines between the points of the grid. Its value depends on the
/// frame of the hop only, not on how the hop is cut into calls.
class HopRamp
{
public:
    /// To `target` at once.
    void jump(double target) noexcept
    {
        from = goal = target;
        step = 0.0;
    }

    /// At the start of a hop: goes the part `share` (0 to 1) of the way to `target` until its end. The last millionth
    /// is jumped, so that a gain arrives.
    void aim(double target, double share) noexcept
    {
        from = goal;
        goal = std::abs(target - from) <= 1e-6 ? target : from + share * (target - from);
        step = (goal - from) / static_cast<double>(controlHop);
    }

    /// At frame `frame` of the hop, 0 to controlHop - 1.
    [[nodiscard]] double at(std::size_t frame) const noexcept { return from + static_cast<double>(frame + 1) * step; }
    [[nodiscard]] double start() const noexcept { return from; }
    [[nodiscard]] double end() const noexcept { return goal; }

    /// Whether it is 0 during the whole hop.
    [[nodiscard]] bool silent() const noexcept { return from == 0.0 && goal == 0.0; }

private:
    double from = 0.0;
    double goal = 0.0;
    double step = 0.0;
};

/// The share of the way that a one-pole with the time constant `seconds` goes in one hop at `fs` Hz; 1 for 0 s.
[[nodiscard]] inline double hopShare(double seconds, double fs) noexcept
{
    return seconds > 0.0 ? -std::expm1(-static_cast<double>(controlHop) / (seconds * fs)) : 1.0;
}

} // namespace pacini
