#pragma once

// Reader of a drive signal at the pace of another clock than the one that it comes by.

#include "live/LiveDrive.h"

#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace pacini::live
{

/// Resamples a drive signal so that the same number of frames waits in its queue for ever: two crystals that both say
/// 48 kHz differ by some 100 ppm, 0.4 s in an hour. The ratio follows the mean number of waiting frames by a critically
/// damped loop of second order (F. M. Gardner, "Phaselock Techniques", 3rd ed. 2005, chapter 2), which follows a
/// constant difference without a lasting error. Samples in between are those of a cubic through four (Catmull and Rom):
/// a drive ends at 1 kHz, where its error at 48 kHz is below -70 dB.
///
/// When the queue runs empty there is silence until it holds the wanted number again. When it holds 50 ms more, such as
/// after a standstill of the reader, the oldest are dropped.
class TrackedDrive
{
public:
    /// `wanted` frames wait in `from`, which outlives this: at least as many as come and go at a time.
    TrackedDrive(LiveDrive& from, double fromRate, double toRate, std::size_t wanted)
        : source(from), fs(fromRate), nominal(fromRate / toRate), target(static_cast<double>(wanted)), mean(target)
    {
    }

    /// The next frames. [audio]
    void read(std::span<float> out) noexcept
    {
        follow(out.size());
        for (float& sample : out)
            sample = next();
    }

    /// Frames taken for each one read, without the nominal ratio: 1.0002 where the source's clock is 200 ppm faster.
    [[nodiscard]] double correction() const noexcept { return 1.0 + steering; }

    /// Whether all is played.
    [[nodiscard]] bool isOver() const noexcept { return source.isOver(); }

    /// How often the queue ran empty, and too full. [audio]
    [[nodiscard]] std::size_t standstills() const noexcept { return empties + overflows; }

private:
    static constexpr double bandwidth = 2.0 * std::numbers::pi * 0.05; // rad/s
    static constexpr double smoothing = 0.3;                           // s, far above the loop's own speed
    static constexpr double widest = 0.005;                            // of the correction
    static constexpr double longestDelay = 0.050;                      // s above the target

    void follow(std::size_t outFrames) noexcept
    {
        if (source.hasEnded())
        {
            filling = false; // what is left is played
            return;
        }
        auto waiting = static_cast<double>(source.waiting());
        if (waiting > target + longestDelay * fs)
        {
            ++overflows;
            float dropped = 0.0f;
            for (; waiting > target && source.take({&dropped, 1}) == 1; waiting -= 1.0)
            {
            }
            mean = target;
        }
        if (filling)
        {
            if (waiting < target)
                return;
            filling = false;
            mean = waiting;
        }
        const double seconds = static_cast<double>(outFrames) * nominal / fs;
        mean += (waiting - phase - mean) * std::min(1.0, seconds / smoothing);
        const double error = (mean - target) / fs; // s
        drift = std::clamp(drift + bandwidth * bandwidth * error * seconds, -widest, widest);
        steering = std::clamp(2.0 * bandwidth * error + drift, -widest, widest);
    }

    [[nodiscard]] float next() noexcept
    {
        if (filling)
            return 0.0f;
        const double t = phase;
        const double a = static_cast<double>(held[0]), b = static_cast<double>(held[1]);
        const double c = static_cast<double>(held[2]), d = static_cast<double>(held[3]);
        const double value =
            b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
        for (phase += nominal * (1.0 + steering); phase >= 1.0; phase -= 1.0)
        {
            held = {held[1], held[2], held[3], 0.0f};
            if (source.take({&held[3], 1}) == 1)
                continue;
            filling = true; // the three frames in `held` are dropped
            empties += source.hasEnded() ? 0u : 1u;
            phase = 0.0;
            held = {};
            break;
        }
        return static_cast<float>(value);
    }

    LiveDrive& source;
    double fs;
    double nominal;
    double target;         ///< frames, as the next
    double mean;           ///< of those that wait
    double drift = 0.0;    ///< what the loop has learned of the clocks
    double steering = 0.0; ///< drift and what leads back to the target
    double phase = 0.0;
    std::array<float, 4> held{};
    bool filling = true;
    std::size_t empties = 0;
    std::size_t overflows = 0;
};

} // namespace pacini::live
