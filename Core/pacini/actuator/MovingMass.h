#pragma once

// State of a moving mass that follows the drive, frame by frame or by groups of frames.

#include <pacini/actuator/FrameGroup.h>
#include <pacini/actuator/HeldStep.h>
#include <pacini/foundation/DspBlock.h>

#include <array>
#include <cstddef>

namespace pacini
{

/// A held step for every frame of a group at once.
struct GroupStep
{
    HeldStep all;
    FrameGroup drivesToX{};
    FrameGroup drivesToV{};

    [[nodiscard]] ResonatorState next(const ResonatorState& z, const FrameGroup& drives) const noexcept
    {
        double x = 0.0;
        double v = 0.0;
        for (std::size_t k = 0; k < groupFrames; ++k)
        {
            x += drivesToX[k] * drives[k];
            v += drivesToV[k] * drives[k];
        }
        return {(z.displacement + x) + (all.xx * z.displacement + all.xv * z.velocity),
                (z.velocity + v) + (all.vx * z.displacement + all.vv * z.velocity)};
    }
};

/// `step` as often as a group has frames; a drive goes on moving freely in the frames after its own.
[[nodiscard]] inline GroupStep designGroupStep(const HeldStep& step) noexcept
{
    GroupStep group;
    ResonatorState pushed{step.driveToX, step.driveToV};
    group.all = step;
    for (std::size_t k = groupFrames; k-- > 0; pushed = step.free(pushed))
    {
        group.drivesToX[k] = pushed.displacement;
        group.drivesToV[k] = pushed.velocity;
        if (k > 0)
            group.all = group.all.then(step);
    }
    return group;
}

/// State of the resonator. The state of the mass after every drive so far; see FrameGroup.
class MovingMass
{
public:
    [[nodiscard]] const ResonatorState& state() const noexcept { return now; }

    void follow(double drive, const HeldStep& step, const GroupStep& group) noexcept
    {
        drives[position] = drive;
        now = step.next(now, drive);
        if (++position < groupFrames)
            return;
        position = 0;
        followGroup(drives, group);
    }

    /// Follows the drives of a whole group. Only at the start of a group.
    void followGroup(const FrameGroup& groupDrives, const GroupStep& group) noexcept
    {
        now = start = group.next(start, groupDrives);
    }

    /// Begins a group, for steps of another design.
    void beginGroup() noexcept
    {
        start = now;
        position = 0;
    }

    void flush() noexcept
    {
        for (ResonatorState* state : {&now, &start})
        {
            flushTiny(state->displacement);
            flushTiny(state->velocity);
        }
    }

private:
    ResonatorState now;
    ResonatorState start;
    FrameGroup drives{};
    std::size_t position = 0;
};

} // namespace pacini
