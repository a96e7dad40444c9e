#pragma once

// Live onset detector: detects events as they occur.

#include <pacini/analysis/TransientScore.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pacini
{

/// Detected onset: an event at the moment at which its peak is known.
struct HeardEvent
{
    double amplitude = 0.0; ///< full-band peak
    double gap = 0.0;       ///< s since the event before
};

/// Live onset detector. The relative score of TransientDetector, (fast - slow) / (slow + floor), on the peaks of the
/// full band: bright events count that the range of touch hardly holds. TransientDetector itself names an event when
/// nothing later can replace it, 10 ms late; this one waits for the peak for `peakWait` only and then stays silent for
/// `deadTime`, since skin takes two events within 8 to 10 ms for one. The release is short enough for 60 events a
/// second, the hold outlasts the half waves of 50 Hz.
class LiveOnsetDetector
{
public:
    static constexpr double peakWait = 0.001; ///< s
    static constexpr double deadTime = 0.010; ///< s between two events

    void prepare(double fs) noexcept
    {
        sampleRate = fs;
        TransientScoreParams params;
        params.reading = TransientScoreReading::relative;
        params.floor = 0.02;
        params.fastAttack = Seconds(0.0005);
        params.slowAttack = Seconds(0.030);
        params.hold = Seconds(0.010);
        params.release = Seconds(0.025);
        score.prepare({fs, 1});
        score.setParams(params);
        waitFrames = static_cast<std::size_t>(std::lround(peakWait * fs));
        deadFrames = static_cast<std::size_t>(std::lround(deadTime * fs));
        reset();
    }

    void reset() noexcept
    {
        score.reset();
        waiting = 0;
        sinceEvent = longest;
        peak = 0.0;
        armed = true;
    }

    /// Takes the full-band peak of one more inner frame; true when an event is complete, which `heard` then is.
    [[nodiscard]] bool tick(double level, double threshold, HeardEvent& heard) noexcept
    {
        const double now = score.tick(level);
        sinceEvent = std::min(sinceEvent + 1, longest);
        if (waiting > 0)
        {
            peak = std::max(peak, level);
            if (--waiting > 0)
                return false;
            heard = {peak, gap};
            return true;
        }
        if (now < 0.5 * threshold)
            armed = true;
        if (!armed || now < threshold || sinceEvent < deadFrames)
            return false;
        armed = false;
        gap = static_cast<double>(sinceEvent) / sampleRate;
        sinceEvent = 0;
        waiting = waitFrames + 1;
        peak = level;
        return false;
    }

    /// Frames since the newest event began, which is not reported yet while its peak is awaited.
    [[nodiscard]] std::size_t framesSinceEvent() const noexcept { return sinceEvent; }

    /// Frames from the beginning of an event to its report.
    [[nodiscard]] std::size_t delayFrames() const noexcept { return waitFrames + 1; }

    void flush() noexcept { score.flush(); }

private:
    static constexpr std::size_t longest = std::size_t(1) << 30;

    double sampleRate = 6000.0;
    TransientScore score;
    std::size_t waitFrames = 0, deadFrames = 0;
    std::size_t waiting = 0;
    std::size_t sinceEvent = longest;
    double gap = 0.0;
    double peak = 0.0;
    bool armed = true;
};

} // namespace pacini
