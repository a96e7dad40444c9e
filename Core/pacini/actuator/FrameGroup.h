#pragma once

// Block recursion: the grid on which recursions may take several frames in one step, because waiting for every frame is
// slow.

#include <array>
#include <cstddef>
#include <span>

namespace pacini
{

/// A recursion waits for its own last value at every frame, some ten cycles of the processor each time. A step over a
/// whole group waits once: what the group's frames add does not depend on the state. Such a step rounds otherwise than
/// single steps do, so the groups lie on a fixed grid from the last reset() or design() on, and single steps that reach
/// the end of a group arrive at the same number as the step over it: the result does not depend on who takes which.
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
