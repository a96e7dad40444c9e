#pragma once

// One-pole low-pass (exponential average), frame by frame or by groups of frames.

#include <pacini/actuator/FrameGroup.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Pair.h>

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace pacini
{

/// One-pole low-pass: mean += leak * (x - mean) for every x. The mean at the start of a group (see FrameGroup) and the
/// part that the group's frames add are kept apart.
class RunningMean
{
public:
    /// Starts a group and keeps the mean. `leak` is between 0 and 1.
    void design(double leakOfFrame) noexcept
    {
        start = value();
        added = 0.0;
        position = 0;
        leak = leakOfFrame;
        keep = 1.0 - leak;
        // keep^k - 1: the 1 would swallow the digits of small leaks
        for (std::size_t k = 0; k < partFrames; ++k)
            lost[k + 1] = lost[k] - leak * (1.0 + lost[k]);
    }

    void reset() noexcept
    {
        start = added = 0.0;
        position = 0;
    }

    [[nodiscard]] double value() const noexcept { return after(position, added); }

    void follow(double x) noexcept { follow(x, 0.0); }

    /// Follows x + rest, where `leakOfRest` is leakPerFrame() times the rest: if the rest comes late because it depends
    /// on the mean, only this waits for it.
    void follow(double x, double leakOfRest) noexcept
    {
        added = (keep * added + leak * x) + leakOfRest;
        if (++position < partFrames)
            return;
        start = value();
        added = 0.0;
        position = 0;
    }
    [[nodiscard]] double leakPerFrame() const noexcept { return leak; }

    /// Follows the `groupFrames` numbers of a whole group and returns the mean after each of them. Only at the start of
    /// a group.
    FrameGroup followGroup(const FrameGroup& x) noexcept
    {
        FrameGroup means;
        for (std::size_t i = 0; i < groupFrames; i += partFrames)
        {
            double part = 0.0;
            for (std::size_t k = 0; k < partFrames; ++k)
            {
                part = keep * part + leak * x[i + k];
                means[i + k] = after(k + 1, part);
            }
            start = means[i + partFrames - 1];
        }
        return means;
    }

    /// followGroup() of two means with the same leak, side by side: their numbers are those of the first and the
    /// second.
    [[nodiscard]] static std::array<Pair, groupFrames> followGroups(RunningMean& first, RunningMean& second,
                                                                    const std::array<Pair, groupFrames>& x) noexcept
    {
        assert(first.leak == second.leak);
        std::array<Pair, groupFrames> means;
        Pair starts(first.start, second.start);
        for (std::size_t i = 0; i < groupFrames; i += partFrames)
        {
            Pair part(0.0);
            for (std::size_t k = 0; k < partFrames; ++k)
            {
                part = Pair(first.keep) * part + Pair(first.leak) * x[i + k];
                means[i + k] = starts + (Pair(first.lost[k + 1]) * starts + part);
            }
            starts = means[i + partFrames - 1];
        }
        first.start = means.back().first();
        second.start = means.back().second();
        return means;
    }

    /// Follows so many zeros at once. A group goes on where it was; equal to follow() but for rounding.
    void decay(double frames) noexcept
    {
        const double share = std::exp(frames * std::log1p(-leak));
        start *= share;
        added *= share;
    }

    void flush() noexcept
    {
        flushTiny(start);
        flushTiny(added);
    }

private:
    /// Within a group the mean is kept anew so often: parts of it do not wait for each other.
    static constexpr std::size_t partFrames = groupFrames / 2;

    [[nodiscard]] double after(std::size_t frames, double part) const noexcept
    {
        return start + (lost[frames] * start + part);
    }

    double leak = 0.0;
    double keep = 1.0;
    std::array<double, partFrames + 1> lost{};
    double start = 0.0;
    double added = 0.0;
    std::size_t position = 0;
};

} // namespace pacini
