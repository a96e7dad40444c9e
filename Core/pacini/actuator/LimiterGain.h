#pragma once

// Gain computer of a limiter: knee, hold, release, look-ahead.

#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Portable.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace pacini
{

/// The maximum over a window that slides with time (D. Lemire, "Streaming maximum-minimum filter using no more than
/// three comparisons per element", Nordic Journal of Computing 13, 2006): of the values in the window only those are
/// kept that no later one reaches. A frame costs a constant on average; one frame alone can cost as many steps as the
/// window is long, but only after as many cheap ones.
class SlidingMaximum
{
public:
    /// Allocates room for windows of up to `maxFrames`, 1 at least.
    void prepare(std::size_t maxFrames)
    {
        kept.assign(std::max<std::size_t>(maxFrames, 1), {});
        setLength(length);
        reset();
    }

    /// The newest `frames` values count, 1 at least and at most what there is room for.
    void setLength(std::size_t frames) noexcept
    {
        length = std::clamp<std::size_t>(frames, 1, kept.size());
        dropOld();
    }

    void reset() noexcept { count = 0; }

    /// Whether no value is in the window.
    [[nodiscard]] bool empty() const noexcept { return count == 0; }

    /// The largest value in the window, which must not be empty.
    [[nodiscard]] double largest() const noexcept { return kept[first].value; }

    /// The next frame, with a value.
    void push(double value) noexcept
    {
        skip();
        while (count > 0 && kept[at(count - 1)].value <= value)
            --count;
        kept[at(count)] = {value, now};
        ++count;
    }

    /// The next frame, which has no value.
    void skip() noexcept
    {
        ++now;
        dropOld();
    }

private:
    struct Kept
    {
        double value = 0.0;
        std::uint64_t frame = 0;
    };

    [[nodiscard]] std::size_t at(std::size_t i) const noexcept
    {
        const std::size_t index = first + i;
        return index < kept.size() ? index : index - kept.size();
    }

    void dropOld() noexcept
    {
        while (count > 0 && now - kept[first].frame >= length)
        {
            first = at(1);
            --count;
        }
    }

    std::vector<Kept> kept = std::vector<Kept>(1); ///< a ring, oldest and largest first
    std::size_t first = 0;
    std::size_t count = 0;
    std::size_t length = 1;
    std::uint64_t now = 0;
};

/// A soft knee of 2 dB (D. Giannoulis, M. Massberg and J. Reiss, "Digital dynamic range compressor design", JAES 2012,
/// eq. 4, ratio infinite): unity up to 1 dB below the limit, exactly the limit from 1 dB above it.
struct SoftKnee
{
    static constexpr double width = 2.0; ///< dB

    /// The gain for a level whose square is `ratioSquared` times that of the limit.
    [[nodiscard]] static double gain(double ratioSquared) noexcept
    {
        return ratioSquared < endSquared ? gainAt(into(ratioSquared)) : 1.0 / std::sqrt(ratioSquared);
    }

    /// Returns the distance into the knee, in nepers: exp and log take a third of the time of powers of 10.
    [[nodiscard]] static double into(double ratioSquared) noexcept { return 0.5 * std::log(ratioSquared) + half; }

    /// The gain so far into it, up to its end.
    [[nodiscard]] static double gainAt(double into) noexcept
    {
        return into > 0.0 ? std::exp(-into * into / (4.0 * half)) : 1.0;
    }

    static constexpr double half = 0.25 * width * (std::numbers::ln10 / 10.0); ///< nepers up to the limit
    static constexpr double startSquared = 0.7943282347242815;                 ///< -1 dB: up to it the gain is 1
    static constexpr double endSquared = 1.2589254117941673;                   ///< +1 dB
};

/// Hard knee: unity gain up to the limit, so that signals within the limit stay unchanged; exactly the limit above it.
struct HardKnee
{
    [[nodiscard]] static double gain(double ratioSquared) noexcept
    {
        return ratioSquared > startSquared ? 1.0 / std::sqrt(ratioSquared) : 1.0;
    }
    static constexpr double startSquared = 1.0; ///< up to it the gain is 1
};

/// Gain computer. The gain that brings a level down to its limit. It answers the highest level within the time of
/// `hold` (half a period of the lowest tone: the gain does not follow the waveform), which it then lets go by 40 dB/s.
/// With a look-ahead of n frames the gain is the mean of its newest n + 1 values, so that it arrives gradually at the
/// frame that needs it, n frames after the level was told; hold must not be shorter than the look-ahead. Without
/// look-ahead the gain acts at once.
///
/// Nothing here is decided by comparing peaks, so the gain is a continuous function of the levels: what changes no
/// level by more than d (parts of the limit) changes no frame behind the gain by more than its own change and d.
/// LimitedError builds on that.
template <typename Knee>
class KneeLimiterGain
{
public:
    static constexpr double releaseRate = 40.0; ///< dB/s

    /// Allocates room for look-aheads of up to `maxLookAhead` frames and holds of up to `maxHold`.
    void prepare(std::size_t maxLookAhead, std::size_t maxHold)
    {
        window.assign(maxLookAhead + 1, 1.0);
        newest.prepare(std::max(maxHold, maxLookAhead + 1) + 1);
    }

    void design(std::size_t lookAheadFrames, std::size_t holdFrames, double fs) noexcept
    {
        newest.setLength(std::max(holdFrames, lookAheadFrames + 1) + 1);
        decay = portable::exp10(-releaseRate / (10.0 * fs));
        fall = -0.05 * std::numbers::ln10 * releaseRate / fs;
        if (lookAheadFrames + 1 != length)
        {
            length = std::min(lookAheadFrames + 1, window.size());
            perLength = 1.0 / static_cast<double>(length);
            reset();
        }
    }

    void reset() noexcept
    {
        std::fill(window.begin(), window.end(), 1.0);
        newest.reset();
        held = Knee::startSquared;
        target = 1.0;
        inKnee = false;
        position = 0;
        sum = static_cast<double>(length);
        lap = 0.0;
        unity = length;
    }

    /// Whether the gain is 1, and stays so as long as no level exceeds Knee::startSquared.
    [[nodiscard]] bool idle() const noexcept { return unity >= length; }

    /// Takes the square of the level over its limit and returns the gain, between 0 and 1.
    double tick(double ratioSquared) noexcept
    {
        const bool matters = ratioSquared > Knee::startSquared;
        if (idle())
        {
            if (!matters)
                return 1.0;
            position = 0;
            sum = static_cast<double>(length);
            lap = 0.0;
        }
        if (matters)
            newest.push(ratioSquared);
        else
            newest.skip();
        const double before = held;
        held = std::max(held * decay, newest.empty() ? Knee::startSquared : newest.largest());
        if (held != before)
            target = gainOf(held == before * decay);
        unity = target == 1.0 ? std::min(unity + 1, length) : 0;

        sum += target - window[position];
        window[position] = target;
        lap += target;
        if (++position == length)
        {
            sum = lap; // formed anew, so that rounding cannot build up
            lap = 0.0;
            position = 0;
        }
        return idle() ? 1.0 : std::min(sum * perLength, 1.0);
    }

private:
    /// Returns the gain for the held level. `released` tells that the level fell by one frame's release. Within a knee,
    /// a release is a step on the knee without a logarithm; a limiter spends most of its time in release.
    double gainOf(bool released) noexcept
    {
        if constexpr (requires { Knee::gainAt(0.0); })
        {
            const bool wasInKnee = inKnee;
            inKnee = held > Knee::startSquared && held < Knee::endSquared;
            if (inKnee)
            {
                into = released && wasInKnee ? into + fall : Knee::into(held);
                return Knee::gainAt(into);
            }
        }
        return held > Knee::startSquared ? Knee::gain(held) : 1.0;
    }

    SlidingMaximum newest; ///< of the levels that matter
    double decay = 1.0;
    double fall = 0.0; ///< the same in nepers
    double held = Knee::startSquared;
    bool inKnee = false;
    double into = 0.0; ///< nepers
    double target = 1.0;
    std::size_t unity = 1; // how often the target has been 1 of late
    std::size_t length = 1;
    double perLength = 1.0;
    std::size_t position = 0;
    double sum = 1.0;
    double lap = 0.0;
    std::vector<double> window = std::vector<double>(1, 1.0);
};

inline constexpr double longestLimiterHold = 0.05; // s

/// Returns the hold time of a limiter for the lowest tone `low`, s: half its period, within 2 to 50 ms.
[[nodiscard]] inline double limiterHold(Hertz low) noexcept
{
    return clampTo(0.5 / clampTo(low.value, 1.0, 20000.0), 0.002, longestLimiterHold);
}

using LimiterGain = KneeLimiterGain<SoftKnee>;

} // namespace pacini
