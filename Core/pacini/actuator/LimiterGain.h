#pragma once

// The gain of a limiter: knee, hold, release, look-ahead.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pacini
{

/// A soft knee of 2 dB (D. Giannoulis, M. Massberg and J. Reiss, "Digital dynamic range compressor design", JAES 2012,
/// eq. 4, ratio infinite): unity up to 1 dB below the limit, exactly the limit from 1 dB above it.
struct SoftKnee
{
    static constexpr double width = 2.0; ///< dB

    /// The gain for a level whose square is `ratioSquared` times that of the limit.
    [[nodiscard]] static double gain(double ratioSquared) noexcept
    {
        if (ratioSquared >= endSquared)
            return 1.0 / std::sqrt(ratioSquared);
        const double over = 10.0 * std::log10(ratioSquared) + width / 2.0;
        const double reduction = over < 0.0 ? 0.0 : over * over / (2.0 * width);
        return std::pow(10.0, -reduction / 20.0);
    }
    static constexpr double startSquared = 0.7943282347242815; ///< -1 dB: up to it the gain is 1
    static constexpr double endSquared = 1.2589254117941673;   ///< +1 dB
};

/// No knee: unity up to the limit, so that what keeps it by itself is not touched, exactly the limit above it.
struct HardKnee
{
    [[nodiscard]] static double gain(double ratioSquared) noexcept
    {
        return ratioSquared > startSquared ? 1.0 / std::sqrt(ratioSquared) : 1.0;
    }
    static constexpr double startSquared = 1.0; ///< up to it the gain is 1
};

/// The gain that brings a level down to its limit. It holds the highest level for the time of `hold` (half a period of
/// the lowest tone: the gain does not follow the waveform), then lets it go by 40 dB/s. With a look-ahead of n frames
/// the gain is the mean of its newest n + 1 values, so that it arrives gradually at the frame that needs it, n frames
/// after the level was told; hold must not be shorter than the look-ahead. Without look-ahead the gain acts at once.
template <typename Knee>
class KneeLimiterGain
{
public:
    static constexpr double releaseRate = 40.0; ///< dB/s

    /// Allocates room for look-aheads of up to `maxLookAhead` frames.
    void prepare(std::size_t maxLookAhead) { window.assign(maxLookAhead + 1, 1.0); }

    void design(std::size_t lookAheadFrames, std::size_t holdFrames, double fs) noexcept
    {
        hold = std::max(holdFrames, lookAheadFrames + 1);
        decay = std::pow(10.0, -releaseRate / (10.0 * fs));
        if (lookAheadFrames + 1 != length)
        {
            length = std::min(lookAheadFrames + 1, window.size());
            reset();
        }
    }

    void reset() noexcept
    {
        std::fill(window.begin(), window.end(), 1.0);
        held = Knee::startSquared;
        left = 0;
        target = 1.0;
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
        if (idle())
        {
            if (!(ratioSquared > Knee::startSquared))
                return 1.0;
            position = 0;
            sum = static_cast<double>(length);
            lap = 0.0;
        }
        const double before = held;
        if (ratioSquared > held)
            held = ratioSquared;
        if (ratioSquared >= samePeak * held)
            left = hold;
        else if (left > 0)
            --left;
        else
            held = std::max({ratioSquared, held * decay, Knee::startSquared}); // all lower ones are the same
        if (held != before)
            target = held > Knee::startSquared ? Knee::gain(held) : 1.0;
        unity = target == 1.0 ? unity + 1 : 0;

        sum += target - window[position];
        window[position] = target;
        lap += target;
        if (++position == length)
        {
            sum = lap; // formed anew, so that rounding cannot build up
            lap = 0.0;
            position = 0;
        }
        return sum / static_cast<double>(length);
    }

private:
    static constexpr double samePeak = 0.9; // the next peak of the same tone, met by other samples

    std::size_t hold = 1;
    double decay = 1.0;
    double held = Knee::startSquared;
    std::size_t left = 0;
    double target = 1.0;
    std::size_t unity = 1; // how often the target has been 1 of late
    std::size_t length = 1;
    std::size_t position = 0;
    double sum = 1.0;
    double lap = 0.0;
    std::vector<double> window = std::vector<double>(1, 1.0);
};

using LimiterGain = KneeLimiterGain<SoftKnee>;

} // namespace pacini
