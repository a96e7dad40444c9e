#pragma once

// Glide: a value that moves linearly to its target.

#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cstddef>

namespace pacini
{

/// Returns the frames of a glide of `seconds`, at most an hour; 0 for values not above 0 (NaN too).
[[nodiscard]] inline std::size_t framesOfGlide(Seconds glide, double fs) noexcept
{
    return glide.value > 0.0 ? static_cast<std::size_t>(std::min(glide.value, 3600.0) * fs + 0.5) : 0;
}

/// A control value that moves linearly, one step per frame, independent of block sizes; it reaches the target exactly.
class Glide
{
public:
    explicit Glide(double start = 0.0) noexcept : value(start), target(start) {}

    /// Reaches `wanted` (finite) after `frames` frames, at once for 0. [audio]
    void glideTo(double wanted, std::size_t frames) noexcept
    {
        target = wanted;
        left = wanted == value ? 0 : frames;
        if (left == 0)
            value = wanted;
        else
            step = (wanted - value) / static_cast<double>(left);
    }

    [[nodiscard]] bool resting() const noexcept { return left == 0; }
    [[nodiscard]] bool restsAt(double at) const noexcept { return left == 0 && value == at; }
    [[nodiscard]] double now() const noexcept { return value; }
    [[nodiscard]] double goal() const noexcept { return target; }
    [[nodiscard]] std::size_t framesLeft() const noexcept { return left; }

    /// The value of this frame; moves on to the next one. [audio]
    double next() noexcept
    {
        const double current = value;
        if (left > 0)
            value = --left == 0 ? target : value + step;
        return current;
    }

    /// Moves on by `frames`. [audio]
    void skip(std::size_t frames) noexcept
    {
        for (; frames > 0 && left > 0; --frames)
            next();
    }

    /// As skip(), in one step: rounds differently, but takes constant time. [audio]
    void jump(std::size_t frames) noexcept
    {
        if (frames >= left)
            glideTo(target, 0);
        else
        {
            value += step * static_cast<double>(frames);
            left -= frames;
        }
    }

private:
    double value, target, step = 0.0;
    std::size_t left = 0;
};

} // namespace pacini
