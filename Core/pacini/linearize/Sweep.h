#pragma once

// The exponential sine sweep that actuators are measured with.

#include <pacini/foundation/Result.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace pacini
{

/// The sweeps of one measurement. Each of the levels is played `repeats` times.
struct SweepParams
{
    double lowFrequency = 10.0;         ///< Hz, 1 to 2000
    double highFrequency = 1500.0;      ///< Hz, at least 1.5 times lowFrequency, at most 0.45 of the sample rate
    double duration = 20.0;             ///< s of each sweep, 0.5 to 600
    double fadeIn = 0.1;                ///< s, raised cosine; both fades together at most half of the duration
    double fadeOut = 0.02;              ///< s
    int repeats = 1;                    ///< 1 to 100
    double pause = 1.0;                 ///< s of silence before, between and after, 0.2 to 30: longer than the actuator
                                        ///< and its mount ring
    std::vector<double> levels = {-10}; ///< dB re full scale, 1 to 32 of -80 to 0
    double markerDuration = 0.5;        ///< s of the short sweeps before and after all others, 0.2 to 5; 0 for none
    double sampleRate = 48000.0;        ///< Hz, a whole number of 2000 to 384000
    bool operator==(const SweepParams&) const = default;
};

/// Exponential sine sweep x(t) = sin(2 pi f1 L (e^(t / L) - 1)), L = T / ln(f2 / f1), between two raised-cosine fades
/// (A. Farina, "Simultaneous measurement of impulse response and distortion with a swept-sine technique", AES 108th
/// convention, 2000, eq. 1). A function of continuous time rather than a list of samples, so that it can be had at any
/// rate, at fractional delays and by any clock without a resampler's error.
class ExponentialSweep
{
public:
    /// Frequencies in Hz and times in s as in SweepParams, valid.
    ExponentialSweep(double low, double high, double seconds, double fadeInTime, double fadeOutTime) noexcept
        : f1(low), duration(seconds), growth(seconds / std::log(high / low)), fadeIn(fadeInTime), fadeOut(fadeOutTime)
    {
    }

    /// L, s: the time in which the frequency grows by e.
    [[nodiscard]] double growthTime() const noexcept { return growth; }
    [[nodiscard]] double seconds() const noexcept { return duration; }
    [[nodiscard]] double lowFrequency() const noexcept { return f1; }

    /// The time after the start, s, at which the sweep passes `frequency` Hz.
    [[nodiscard]] double timeOf(double frequency) const noexcept { return growth * std::log(frequency / f1); }

    /// The frequency, Hz, that the sweep passes `time` seconds after its start.
    [[nodiscard]] double frequencyAt(double time) const noexcept { return f1 * std::exp(time / growth); }

    /// The sample at `t` seconds; 0 outside of the sweep. Whole turns are taken out before the sine: 1e-9 of a turn is
    /// right after an hour.
    [[nodiscard]] double at(double t) const noexcept
    {
        if (!(t >= 0.0 && t < duration))
            return 0.0;
        const double turns = f1 * growth * std::expm1(t / growth);
        return gain(t) * std::sin(2.0 * std::numbers::pi * (turns - std::floor(turns)));
    }

    /// The same sweep as a clock sees it that counts (1 + drift) seconds for each of ours: an exponential sweep again,
    /// f1 / (1 + drift) with L (1 + drift).
    [[nodiscard]] ExponentialSweep byClock(double drift) const noexcept
    {
        ExponentialSweep sweep = *this;
        const double stretch = 1.0 + drift;
        sweep.f1 /= stretch;
        sweep.duration *= stretch;
        sweep.growth *= stretch;
        sweep.fadeIn *= stretch;
        sweep.fadeOut *= stretch;
        return sweep;
    }

private:
    [[nodiscard]] double gain(double t) const noexcept
    {
        const auto raised = [](double part)
        {
            return part >= 1.0 ? 1.0 : 0.5 - 0.5 * std::cos(std::numbers::pi * part);
        };
        return (fadeIn > 0.0 ? raised(t / fadeIn) : 1.0) * (fadeOut > 0.0 ? raised((duration - t) / fadeOut) : 1.0);
    }

    double f1;
    double duration;
    double growth;
    double fadeIn;
    double fadeOut;
};

/// The sweep of a measurement, unscaled.
[[nodiscard]] inline ExponentialSweep measuringSweep(const SweepParams& params) noexcept
{
    return {params.lowFrequency, params.highFrequency, params.duration, params.fadeIn, params.fadeOut};
}

/// The short sweep before and after the others, over the same frequencies: the same response twice shows how far the
/// two clocks went apart, whatever the response is. Fades of a fiftieth.
[[nodiscard]] inline ExponentialSweep markerSweep(const SweepParams& params) noexcept
{
    const double fade = params.markerDuration / 50.0;
    return {params.lowFrequency, params.highFrequency, params.markerDuration, fade, fade};
}

/// Checks every number of SweepParams. ErrorCode::invalidArgument with the path of the first wrong one, such as
/// `levels[2]`; tooLarge when all sweeps together would last more than two hours.
[[nodiscard]] inline Result<void> validate(const SweepParams& params)
{
    const auto wrong = [](std::string where, const char* message) -> Result<void>
    {
        return Error{ErrorCode::invalidArgument, std::move(where), message};
    };
    const auto within = [](double value, double low, double high)
    {
        return value >= low && value <= high; // not for NaN
    };
    if (!within(params.sampleRate, 2000.0, 384000.0) || params.sampleRate != std::floor(params.sampleRate))
        return wrong("sampleRate", "must be a whole number of 2000 to 384000 Hz");
    if (!within(params.lowFrequency, 1.0, 2000.0))
        return wrong("lowFrequency", "must be 1 to 2000 Hz");
    if (!within(params.highFrequency, 1.5 * params.lowFrequency, 0.45 * params.sampleRate))
        return wrong("highFrequency", "must be 1.5 times the low frequency to 0.45 of the sample rate");
    if (!within(params.duration, 0.5, 600.0))
        return wrong("duration", "must be 0.5 to 600 s");
    if (!within(params.fadeIn, 0.0, params.duration / 2.0))
        return wrong("fadeIn", "must be 0 s to half of the duration");
    if (!within(params.fadeOut, 0.0, params.duration / 2.0 - params.fadeIn))
        return wrong("fadeOut", "must be 0 s or more, together with fadeIn at most half of the duration");
    if (params.repeats < 1 || params.repeats > 100)
        return wrong("repeats", "must be 1 to 100");
    if (!within(params.pause, 0.2, 30.0))
        return wrong("pause", "must be 0.2 to 30 s");
    if (params.levels.empty() || params.levels.size() > 32)
        return wrong("levels", "must be 1 to 32 levels");
    for (std::size_t i = 0; i < params.levels.size(); ++i)
        if (!within(params.levels[i], -80.0, 0.0))
            return wrong("levels[" + std::to_string(i) + "]", "must be -80 to 0 dB");
    if (params.markerDuration != 0.0 && !within(params.markerDuration, 0.2, 5.0))
        return wrong("markerDuration", "must be 0.2 to 5 s, or 0 for none");
    const double sweeps = static_cast<double>(params.levels.size()) * static_cast<double>(params.repeats);
    if (sweeps * (params.duration + params.pause) > 7200.0)
        return Error{ErrorCode::tooLarge, "repeats", "all sweeps together last more than two hours"};
    return {};
}

/// The samples of `sweep` at `fs` Hz, scaled by `gain`: round(seconds fs) of them.
[[nodiscard]] inline std::vector<float> sampleSweep(const ExponentialSweep& sweep, double fs, double gain = 1.0)
{
    std::vector<float> x(static_cast<std::size_t>(std::lround(sweep.seconds() * fs)));
    for (std::size_t n = 0; n < x.size(); ++n)
        x[n] = static_cast<float>(gain * sweep.at(static_cast<double>(n) / fs));
    return x;
}

/// Returns the start frequency of a verification sweep: slightly below `lowest` Hz, the lowest frequency of the
/// equalizer to verify, for a sweep from `low` to `high` Hz. Lower frequencies keep their level and would set the peak,
/// so that the rest would vanish in the noise of the sensor.
[[nodiscard]] inline double provingLowFrequency(double low, double high, double lowest) noexcept
{
    return std::max(low, std::min(0.8 * lowest, 0.25 * high));
}

} // namespace pacini
