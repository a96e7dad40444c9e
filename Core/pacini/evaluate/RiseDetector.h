#pragma once

// Rise detector: events as steep rises of envelopes.

#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <numeric>
#include <span>
#include <vector>

namespace pacini
{

/// Indices of the local maxima of x that are at least `height` high and at least `distance` samples apart, in order. Of
/// two that are closer, the higher one stays (of equal ones the later). A plateau counts once, at its middle (rounded
/// down); the first and the last sample are never maxima. Same rules as scipy.signal.find_peaks(x, height,
/// distance=...).
[[nodiscard]] inline std::vector<std::size_t> findPeaks(std::span<const double> x, double height, std::size_t distance)
{
    std::vector<std::size_t> peaks;
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
    {
        if (!(x[i - 1] < x[i]))
            continue;
        std::size_t end = i + 1;
        while (end + 1 < x.size() && x[end] == x[i])
            ++end;
        if (x[end] < x[i] && x[i] >= height)
            peaks.push_back((i + end - 1) / 2);
        i = end - 1;
    }

    std::vector<std::size_t> byHeight(peaks.size());
    std::iota(byHeight.begin(), byHeight.end(), std::size_t(0));
    std::stable_sort(byHeight.begin(), byHeight.end(),
                     [&](std::size_t a, std::size_t b) { return x[peaks[a]] < x[peaks[b]]; });
    std::vector<bool> keep(peaks.size(), true);
    for (std::size_t rank = byHeight.size(); rank-- > 0;)
    {
        const std::size_t strong = byHeight[rank];
        if (!keep[strong])
            continue;
        for (std::size_t i = strong; i-- > 0 && peaks[strong] - peaks[i] < distance;)
            keep[i] = false;
        for (std::size_t i = strong + 1; i < peaks.size() && peaks[i] - peaks[strong] < distance; ++i)
            keep[i] = false;
    }
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < peaks.size(); ++i)
        if (keep[i])
            kept.push_back(peaks[i]);
    return kept;
}

/// The envelope grid of the detector is 1 ms.
struct RiseDetectorParams
{
    Decibels floor{-30.0};       ///< relative to the highest value of the first envelope; added to every envelope
    Decibels rise{12.0};         ///< an event rises at least this much within `spanFrames`
    std::size_t spanFrames = 10; ///< ms
    std::size_t gapFrames = 50;  ///< ms, least distance of two events
};

/// Frames (ms) at which the largest rise of any of the envelopes has a maximum of at least params.rise; the rise at t
/// compares the levels at t and t - span, before the start there is silence. All envelopes have equal length, linear
/// amplitudes from 0, one value per ms. No events when the first envelope is zero or empty.
/// Works on ratios: the logarithm of a level difference has its maxima where the ratio has them.
[[nodiscard]] inline std::vector<std::size_t> detectRises(std::initializer_list<std::span<const float>> envelopes,
                                                          const RiseDetectorParams& params)
{
    const auto first = *envelopes.begin();
    const float highest = first.empty() ? 0.0f : *std::max_element(first.begin(), first.end());
    if (!(highest > 0.0f))
        return {};
    const double floor = static_cast<double>(highest) * params.floor.gain();
    std::vector<double> rise(first.size() + 2, 1.0); // 0 dB on both sides, so that a rise in the first ms can be found
    for (const auto envelope : envelopes)
        for (std::size_t t = 0; t < envelope.size(); ++t)
        {
            const double before = t < params.spanFrames ? 0.0 : static_cast<double>(envelope[t - params.spanFrames]);
            rise[t + 1] = std::max(rise[t + 1], (static_cast<double>(envelope[t]) + floor) / (before + floor));
        }
    auto peaks = findPeaks(rise, params.rise.gain(), params.gapFrames);
    for (std::size_t& peak : peaks)
        --peak;
    return peaks;
}

} // namespace pacini
