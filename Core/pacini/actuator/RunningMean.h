#pragma once

// One-pole low-pass (exponential average), frame by frame or by groups of frames.

#include <pacini/actuator/FrameGroup.h>
#include <pacini/foundation/DspBlock.h>

#include <array>
#include <cstddef>

namespace pacini
{

/// One-pole low-pass: mean += leak * (x - mean) for every x. The mean at the start of a group (see FrameGroup) and the
/// part that the group's frames add are kept apart.
class RunningMean
{
public:
    /// `leak` between 0 and 1. The mean goes on; a group begins.
    void design(double leakPerFrame) noexcept
    {
        start = value();
        added = 0.0;
        position = 0;
        leak = leakPerFrame;
        keep = 1.0 - leak;
        // keep^k - 1: the 1 would swallow the digits of small leaks
        for (std::size_t k = 0; k < groupFrames; ++k)
            lost[k + 1] = lost[k] - leak * (1.0 + lost[k]);
    }

    void reset() noexcept
    {
        start = added = 0.0;
        position = 0;
    }

    [[nodiscard]] double value() const noexcept { return after(position, added); }

    void follow(double x) noexcept
    {
        added = keep * added + leak * x;
        if (++position < groupFrames)
            return;
        start = value();
        added = 0.0;
        position = 0;
    }

    /// Follows the `groupFrames` numbers of a whole group and returns the mean after each of them. Only at the start of
    /// a group.
    FrameGroup followGroup(const FrameGroup& x) noexcept
    {
        FrameGroup means;
        double part = 0.0;
        for (std::size_t k = 0; k < groupFrames; ++k)
        {
            part = keep * part + leak * x[k];
            means[k] = after(k + 1, part);
        }
        start = means.back();
        return means;
    }

    void flush() noexcept
    {
        flushTiny(start);
        flushTiny(added);
    }

private:
    [[nodiscard]] double after(std::size_t frames, double part) const noexcept
    {
        return start + (lost[frames] * start + part);
    }

    double leak = 0.0;
    double keep = 1.0;
    std::array<double, groupFrames + 1> lost{};
    double start = 0.0;
    double added = 0.0;
    std::size_t position = 0;
};

} // namespace pacini
