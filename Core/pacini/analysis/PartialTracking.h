#pragma once

// Partial tracking: the spectral ridges of a sound as sinusoids that are born, move and die.

#include <pacini/analysis/PowerSpectra.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Parameters of partial tracking.
struct PartialTrackingParams
{
    /// The window resolves partials that are four of its bins apart, 31 Hz; the hop is the step of all partials.
    FrameParams frames{Seconds(0.128), Seconds(0.020)};
    Hertz low{30.0};          ///< peaks outside are left out
    Hertz high{1000.0};       ///< above low
    Decibels floor{-60.0};    ///< amplitudes below this (re 1) are left out
    double glide = 0.06;      ///< relative change of frequency that a partial may make from frame to frame: a semitone
    std::size_t sleep = 1;    ///< frames that a partial may be missing without dying
    std::size_t shortest = 4; ///< frames that a partial lives at least, or it is none
    bool operator==(const PartialTrackingParams&) const = default;
};

/// A sinusoid of the sound at one moment.
struct PartialPoint
{
    double frequency = 0.0; ///< Hz
    double amplitude = 0.0; ///< linear
    bool operator==(const PartialPoint&) const = default;
};

/// A partial: one point for every frame of its life.
struct Partial
{
    std::size_t birth = 0; ///< frame of the first point
    std::vector<PartialPoint> points;
    bool operator==(const Partial&) const = default;

    /// The frame after the last point.
    [[nodiscard]] std::size_t death() const noexcept { return birth + points.size(); }
};

namespace detail
{

/// The peaks of one power spectrum by rising frequency. A peak stands where a parabola through the levels of the
/// largest bin and its neighbours has its top; its amplitude is that of the sine with the power of all bins between
/// the valleys on both sides.
inline void findPeaks(std::span<const double> power, const FrameGrid& grid, const PartialTrackingParams& params,
                      std::vector<PartialPoint>& peaks)
{
    peaks.clear();
    // A sine of amplitude a has the power a^2 window / 4 times the sum of the squared Hann window, 3/8 window.
    const auto window = static_cast<double>(grid.window);
    const double amplitudeSquaredPerPower = 4.0 / (window * window * 3.0 / 8.0);
    const auto first = static_cast<std::size_t>(std::max(1.0, std::floor(params.low.value / grid.frequency(1.0))));
    const auto end = std::min(power.size() - 1, static_cast<std::size_t>(params.high.value / grid.frequency(1.0)) + 2);
    for (std::size_t k = first; k < end; ++k)
    {
        if (!(power[k] > power[k - 1] && power[k] >= power[k + 1]))
            continue;
        std::size_t low = k;
        while (low > 0 && power[low - 1] < power[low])
            --low;
        std::size_t high = k;
        while (high + 1 < power.size() && power[high + 1] < power[high])
            ++high;
        // A bin in a valley belongs half to the peaks on either side.
        double sum = 0.0;
        for (std::size_t i = low; i <= high; ++i)
            sum += (i == low || i == high ? 0.5 : 1.0) * power[i];
        const double amplitude = std::sqrt(sum * amplitudeSquaredPerPower);
        constexpr double tiny = 1e-300;
        const double below = std::log(power[k - 1] + tiny);
        const double here = std::log(power[k] + tiny);
        const double above = std::log(power[k + 1] + tiny);
        const double offset = 0.5 * (below - above) / (below - 2.0 * here + above);
        const double frequency = grid.frequency(static_cast<double>(k) + (std::isfinite(offset) ? offset : 0.0));
        if (amplitude >= params.floor.gain() && frequency >= params.low.value && frequency <= params.high.value)
            peaks.push_back({frequency, amplitude});
    }
}

/// Continues partials from frame to frame.
class PartialTracker
{
public:
    explicit PartialTracker(const PartialTrackingParams& trackingParams) : params(trackingParams) {}

    /// Takes the peaks of the next frame.
    void push(std::span<const PartialPoint> peaks)
    {
        // Strong partials choose first: each takes the nearest peak within its reach that is left.
        std::sort(living.begin(), living.end(),
                  [](const Partial& a, const Partial& b)
                  { return a.points.back().amplitude > b.points.back().amplitude; });
        free.assign(peaks.size(), true);
        for (Partial& partial : living)
            if (const auto peak = nearestFree(peaks, partial.points.back().frequency))
            {
                free[*peak] = false;
                goOn(partial, peaks[*peak]);
            }
        ++frame;
        std::vector<Partial> awake;
        for (Partial& partial : living)
            if (partial.death() + params.sleep >= frame)
                awake.push_back(std::move(partial));
            else
                bury(std::move(partial));
        living = std::move(awake);
        for (std::size_t i = 0; i < peaks.size(); ++i)
            if (free[i])
                living.push_back({frame - 1, {peaks[i]}});
    }

    /// All partials in order of birth, those of one frame by rising frequency.
    [[nodiscard]] std::vector<Partial> finish()
    {
        for (Partial& partial : living)
            bury(std::move(partial));
        living.clear();
        std::sort(dead.begin(), dead.end(),
                  [](const Partial& a, const Partial& b) {
                      return a.birth != b.birth ? a.birth < b.birth
                                                : a.points.front().frequency < b.points.front().frequency;
                  });
        return std::move(dead);
    }

private:
    [[nodiscard]] std::optional<std::size_t> nearestFree(std::span<const PartialPoint> peaks, double frequency) const
    {
        std::optional<std::size_t> nearest;
        double least = params.glide * frequency;
        for (std::size_t i = 0; i < peaks.size(); ++i)
            if (const double distance = std::abs(peaks[i].frequency - frequency); free[i] && distance <= least)
            {
                least = distance;
                nearest = i;
            }
        return nearest;
    }

    /// Continues the partial at `peak`, in a straight line over the frames without a peak.
    void goOn(Partial& partial, const PartialPoint& peak) const
    {
        const PartialPoint before = partial.points.back();
        const std::size_t slept = frame - partial.death();
        for (std::size_t i = 1; i <= slept; ++i)
        {
            const double share = static_cast<double>(i) / static_cast<double>(slept + 1);
            partial.points.push_back({std::lerp(before.frequency, peak.frequency, share),
                                      std::lerp(before.amplitude, peak.amplitude, share)});
        }
        partial.points.push_back(peak);
    }

    void bury(Partial partial)
    {
        if (partial.points.size() >= params.shortest)
            dead.push_back(std::move(partial));
    }

    PartialTrackingParams params;
    std::vector<Partial> living, dead;
    std::vector<bool> free; // which peaks of the frame no partial has taken
    std::size_t frame = 0;  // that comes next
};

} // namespace detail

/// The partials of a sound at fs Hz: peaks of its spectra, joined from frame to frame to the nearest in frequency;
/// what finds no peak dies, peaks that no partial takes are born (R. McAulay and T. Quatieri, "Speech
/// Analysis/Synthesis Based on a Sinusoidal Representation", IEEE Trans. ASSP 34 (1986); X. Serra and J. Smith,
/// "Spectral modeling synthesis", Computer Music Journal 14 (1990), whose guides may sleep). Frame m is centred at m
/// hops of the sound. [any]
[[nodiscard]] inline std::vector<Partial> trackPartials(std::span<const float> sound, double fs,
                                                        const PartialTrackingParams& params = {})
{
    const FrameGrid grid(params.frames, fs);
    detail::PartialTracker tracker(params);
    std::vector<PartialPoint> peaks;
    forEachPowerSpectrum(withCentredFrames(sound, grid), grid,
                         [&](std::size_t, std::span<const double> power)
                         {
                             detail::findPeaks(power, grid, params, peaks);
                             tracker.push(peaks);
                         });
    return tracker.finish();
}

} // namespace pacini
