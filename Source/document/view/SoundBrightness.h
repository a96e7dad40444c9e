#pragma once

// Brightness of a sound: its spectral centroid over time, for views.

#include "document/view/MonoSource.h"

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/SpectralCentroid.h>
#include <pacini/clip/Curve.h>
#include <pacini/filters/RationalDecimator.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

namespace pacini
{

/// Frames that are this far below the loudest have no brightness: what is measured there is noise.
inline constexpr Decibels brightnessFloor{-50.0};

/// The spectral centroid in Hz of what is felt of a sound (`low` to `high`, Hz), every 11.6 ms: spectralCentroid() of
/// the sound at the rate of the analysis, before the encoder keeps as few points of it as do. 0 Hz where the sound is
/// silent beside its loudest part. Empty for no sound at all, and when `cancelled`. Five minutes take half a second.
/// [worker]
[[nodiscard]] inline Curve brightnessOf(const MonoSource& sound, int rate, Hertz low, Hertz high,
                                        const std::atomic<bool>& cancelled)
{
    constexpr std::size_t part = 1 << 16;
    const bool slow = rate <= analysisRate;
    const double fs = slow ? rate : analysisRate;
    std::vector<float> signal, block;
    RationalDecimator decimator(std::max(rate, analysisRate), analysisRate);
    for (std::size_t done = 0; done < sound.frames() && !cancelled; done += block.size())
    {
        block.resize(std::min(part, sound.frames() - done));
        sound.read(static_cast<std::int64_t>(done), block);
        for (float& sample : block)
            sample = std::isfinite(sample) ? std::clamp(sample, -1e6f, 1e6f) : 0.0f;
        if (slow)
            signal.insert(signal.end(), block.begin(), block.end());
        else
            decimator.push(block, signal);
    }
    if (cancelled)
        return {};
    if (!slow)
        decimator.finish(signal);

    SpectralCentroidParams params;
    params.low = low;
    params.high = high;
    Curve curve = spectralCentroid(signal, fs, params);
    const auto half = static_cast<std::size_t>(0.5 * params.frames.window.value * fs);
    std::vector<double> energies(curve.size());
    for (std::size_t m = 0; m < curve.size(); ++m)
    {
        const auto middle = static_cast<std::size_t>(curve[m].time * fs);
        const std::size_t from = std::min(signal.size(), middle - std::min(middle, half));
        const std::size_t to = std::min(signal.size(), middle + half);
        for (std::size_t i = from; i < to; ++i)
            energies[m] += static_cast<double>(signal[i]) * static_cast<double>(signal[i]);
    }
    const double loudest = energies.empty() ? 0.0 : *std::max_element(energies.begin(), energies.end());
    const double enough = std::max(loudest * brightnessFloor.gain() * brightnessFloor.gain(), 1e-12);
    bool any = false;
    for (std::size_t m = 0; m < curve.size(); ++m)
    {
        if (energies[m] < enough)
            curve[m].value = 0.0;
        any = any || curve[m].value > 0.0;
    }
    return any ? curve : Curve{};
}

/// The least and the greatest value of a curve in a stretch of time, as brightnessOf() makes them; both 0 where there
/// is none. Between two points the nearer one counts.
struct BrightnessSpan
{
    double least = 0.0, greatest = 0.0; ///< Hz
};

[[nodiscard]] inline BrightnessSpan brightnessIn(const Curve& curve, double from, double to)
{
    const auto earlier = [](const Breakpoint& p, double t)
    {
        return p.time < t;
    };
    auto first = std::lower_bound(curve.begin(), curve.end(), from, earlier);
    auto last = std::lower_bound(first, curve.end(), to, earlier);
    if (first == last)
    {
        // No point inside: the nearest, where it is no further than points are from each other.
        const double middle = 0.5 * (from + to);
        if (first == curve.end() || (first != curve.begin() && middle - std::prev(first)->time < first->time - middle))
            first = first == curve.begin() ? first : std::prev(first);
        if (first == curve.end() || std::abs(first->time - middle) > FrameParams{}.hop.value)
            return {};
        last = std::next(first);
    }
    BrightnessSpan found;
    for (; first != last; ++first)
        if (first->value > 0.0)
        {
            found.least = found.least > 0.0 ? std::min(found.least, first->value) : first->value;
            found.greatest = std::max(found.greatest, first->value);
        }
    return found;
}

} // namespace pacini
