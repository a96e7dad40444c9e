#pragma once

// Control rate of the translator: the grid on which it decides, and gain ramps from one decision to the next.

#include <array>
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
    /// Sets the value to `target` at once.
    void jump(double target) noexcept
    {
        from = goal = target;
        step = 0.0;
    }

    /// Starts a hop: the value moves by the fraction `share` (0 to 1) of the distance to `target` until its end. The
    /// last millionth is jumped, so that a gain arrives.
    void aim(double target, double share) noexcept
    {
        from = goal;
        goal = std::abs(target - from) <= 1e-6 ? target : from + share * (target - from);
        step = (goal - from) / static_cast<double>(controlHop);
    }

    /// Returns the value at frame `frame` of the hop, 0 to controlHop - 1.
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

/// Amplitude that follows a signal: as HopRamp, but along the quadratic B-spline of the points, without corners and
/// half a hop later. The corners of straight lines, one in each hop, are heard at -50 dB beyond 1.5 kHz.
class HopCurve
{
public:
    void jump(double target) noexcept { points = {target, target, target}; }

    /// Starts a hop: the next point moves by the fraction `share` of the distance to `target`. The last millionth is
    /// jumped.
    void aim(double target, double share) noexcept
    {
        const double from = points[2];
        points = {points[1], from, std::abs(target - from) <= 1e-6 ? target : from + share * (target - from)};
    }

    [[nodiscard]] double at(std::size_t frame) const noexcept
    {
        const double u = static_cast<double>(frame + 1) / static_cast<double>(controlHop);
        const double slope = points[1] - points[0];
        return 0.5 * (points[0] + points[1]) + u * (slope + 0.5 * u * (points[2] - points[1] - slope));
    }
    /// The newest point.
    [[nodiscard]] double end() const noexcept { return points[2]; }
    [[nodiscard]] bool silent() const noexcept { return points == std::array{0.0, 0.0, 0.0}; }

private:
    std::array<double, 3> points{};
};

/// Smoothed parameter: a ramp whose ends follow three one-poles in series. After one one-pole, the slope jumps with the
/// target, which is heard at -40 dB above 1.5 kHz; after three it turns slowly.
class HopGlide
{
public:
    void jump(double target) noexcept
    {
        stages = {target, target, target};
        ramp.jump(target);
    }

    /// Starts a hop: each one-pole moves by the fraction `share` of the distance to its target. The last millionth is
    /// jumped.
    void aim(double target, double share) noexcept
    {
        double towards = target;
        bool there = true;
        for (double& stage : stages)
        {
            stage += share * (towards - stage);
            towards = stage;
            there = there && std::abs(target - stage) <= 1e-6;
        }
        if (there)
            stages = {target, target, target};
        ramp.aim(stages.back(), 1.0);
    }

    [[nodiscard]] double at(std::size_t frame) const noexcept { return ramp.at(frame); }
    [[nodiscard]] double start() const noexcept { return ramp.start(); }
    [[nodiscard]] double end() const noexcept { return ramp.end(); }
    /// Whether it is 0 during the whole hop and does not leave it.
    [[nodiscard]] bool silent() const noexcept { return ramp.silent() && stages == std::array{0.0, 0.0, 0.0}; }

private:
    std::array<double, 3> stages{};
    HopRamp ramp;
};

/// The share of the way that a one-pole with the time constant `seconds` goes in one hop at `fs` Hz; 1 for 0 s.
[[nodiscard]] inline double hopShare(double seconds, double fs) noexcept
{
    return seconds > 0.0 ? -std::expm1(-static_cast<double>(controlHop) / (seconds * fs)) : 1.0;
}

} // namespace pacini
