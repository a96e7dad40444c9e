#pragma once

// State of a moving mass that follows the drive, frame by frame or by groups of frames.

#include <pacini/actuator/FrameGroup.h>
#include <pacini/actuator/HeldStep.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Pair.h>

#include <array>
#include <cstddef>

namespace pacini
{

/// Two resonators side by side.
struct TwoStates
{
    Pair displacement, velocity;

    TwoStates(const ResonatorState& first, const ResonatorState& second) noexcept
        : displacement(first.displacement, second.displacement), velocity(first.velocity, second.velocity)
    {
    }
    TwoStates(Pair x, Pair v) noexcept : displacement(x), velocity(v) {}

    [[nodiscard]] ResonatorState first() const noexcept { return {displacement.first(), velocity.first()}; }
    [[nodiscard]] ResonatorState second() const noexcept { return {displacement.second(), velocity.second()}; }
    [[nodiscard]] Pair energy() const noexcept { return displacement * displacement + velocity * velocity; }
};

/// A held step for every frame of a group at once. Displacement and velocity go side by side.
struct GroupStep
{
    Pair fromX; ///< what a displacement adds to both
    Pair fromV;
    std::array<Pair, groupFrames> fromDrives{};

    /// The same weights, each in both lanes, for two states side by side.
    struct Twice
    {
        Pair displacement, velocity;
    };
    Twice twiceFromX, twiceFromV;
    std::array<Twice, groupFrames> twiceFromDrives{};

    [[nodiscard]] ResonatorState next(const ResonatorState& z, const FrameGroup& drives) const noexcept
    {
        Pair driven(0.0);
        for (std::size_t k = 0; k < groupFrames; ++k)
            driven = driven + fromDrives[k] * Pair(drives[k]);
        const Pair after =
            (Pair(z.displacement, z.velocity) + driven) + (fromX * Pair(z.displacement) + fromV * Pair(z.velocity));
        return {after.first(), after.second()};
    }

    /// next() for two states with drives of their own: the same numbers.
    [[nodiscard]] TwoStates next(const TwoStates& z, const std::array<Pair, groupFrames>& drives) const noexcept
    {
        Pair drivenX(0.0), drivenV(0.0);
        for (std::size_t k = 0; k < groupFrames; ++k)
        {
            drivenX = drivenX + twiceFromDrives[k].displacement * drives[k];
            drivenV = drivenV + twiceFromDrives[k].velocity * drives[k];
        }
        return {(z.displacement + drivenX) +
                    (twiceFromX.displacement * z.displacement + twiceFromV.displacement * z.velocity),
                (z.velocity + drivenV) + (twiceFromX.velocity * z.displacement + twiceFromV.velocity * z.velocity)};
    }
};

/// `step` as often as a group has frames; a drive goes on moving freely in the frames after its own.
[[nodiscard]] inline GroupStep designGroupStep(const HeldStep& step) noexcept
{
    GroupStep group;
    ResonatorState pushed{step.driveToX, step.driveToV};
    HeldStep all = step;
    for (std::size_t k = groupFrames; k-- > 0; pushed = step.free(pushed))
    {
        group.fromDrives[k] = {pushed.displacement, pushed.velocity};
        if (k > 0)
            all = all.then(step);
    }
    group.fromX = {all.xx, all.vx};
    group.fromV = {all.xv, all.vv};
    const auto twice = [](const Pair& weights)
    {
        return GroupStep::Twice{Pair(weights.first()), Pair(weights.second())};
    };
    group.twiceFromX = twice(group.fromX);
    group.twiceFromV = twice(group.fromV);
    for (std::size_t k = 0; k < groupFrames; ++k)
        group.twiceFromDrives[k] = twice(group.fromDrives[k]);
    return group;
}

/// State of the resonator after all drives so far; see FrameGroup.
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

    /// Goes to where it is after whole groups.
    void moveTo(const ResonatorState& state) noexcept { now = start = state; }

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
