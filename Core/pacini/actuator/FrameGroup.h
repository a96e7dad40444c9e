#pragma once

// Groups of frames: the grid on which recursions take several frames in one step, which is faster than single frames.

#include <array>
#include <cstddef>
#include <span>

namespace pacini
{

/// A recursion waits for its last value at every frame, about ten cycles of the processor each time. A step over a
/// whole group waits once, because the contribution of the group's frames does not depend on the state. Such a step
/// rounds differently from single steps. The groups therefore lie on a fixed grid from the last reset() or design() on,
/// and single steps arrive at the same number at the end of a group: the result does not depend on the kind of steps.
inline constexpr std::size_t groupFrames = 8;

/// One number for each frame of a group.
using FrameGroup = std::array<double, groupFrames>;

/// The `groupFrames` numbers of x from x[begin] on.
[[nodiscard]] inline FrameGroup groupAt(std::span<const double> x, std::size_t begin) noexcept
{
    FrameGroup group;
    for (std::size_t k = 0; k < groupFrames; ++k)
        group[k] = x[begin + k];
    return group;
}

} // namespace pacini
