#pragma once

// Measures of the preservation of a sound's part in the range of touch.

#include <pacini/evaluate/HtsFeatures.h>
#include <pacini/evaluate/match/TrackStatistics.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// Preservation of the part of a sound below 300 Hz by a translation. None if the sound has no such part.
struct LowPart
{
    /// Mean over the bands of 30 to 120 and 120 to 300 Hz of the correlation of the envelopes (20 ms) of sound and
    /// drive, -1 to 1. A band counts where its peak is within 20 dB of that of the sound below 1.8 kHz.
    std::optional<double> kept;
    /// Ratio of the felt level in the strongest low events to the level between them, for the drive, as a share of the
    /// same ratio of the sound. None for a sound with fewer than two such events, or less than 6 dB between them.
    std::optional<double> beat;
};

namespace detail
{
/// `values` moved by `lag` to earlier, `count` of them; nothing is 0.
[[nodiscard]] inline std::vector<float> moved(std::span<const float> values, std::ptrdiff_t lag, std::size_t count)
{
    std::vector<float> result(count);
    for (std::size_t i = 0; i < count; ++i)
    {
        const std::ptrdiff_t from = static_cast<std::ptrdiff_t>(i) + lag;
        result[i] = from >= 0 && from < std::ssize(values) ? values[static_cast<std::size_t>(from)] : 0.0f;
    }
    return result;
}

/// Places of the strongest events of a low band: maxima within 6 dB of the largest, 150 ms apart.
[[nodiscard]] inline std::vector<std::size_t> lowEvents(std::span<const float> band)
{
    constexpr std::size_t apart = 30;
    std::vector<std::size_t> places;
    if (band.empty())
        return places;
    const float least = 0.5f * *std::max_element(band.begin(), band.end());
    for (std::size_t i = 0; i < band.size(); ++i)
    {
        const auto around =
            band.subspan(i - std::min(i, apart), std::min(band.size(), i + apart + 1) - (i - std::min(i, apart)));
        if (band[i] > 0.0f && band[i] >= least && band[i] >= *std::max_element(around.begin(), around.end()) &&
            (places.empty() || i - places.back() > apart))
            places.push_back(i);
    }
    return places;
}

/// Mean over `events` but the last of the ratio in dB of the largest level around the event to the median of the level
/// between it and the next one.
[[nodiscard]] inline double beatDepth(std::span<const float> level, std::span<const std::size_t> events)
{
    constexpr std::size_t before = 4, after = 12; // values: 20 and 60 ms
    double sum = 0.0;
    for (std::size_t e = 0; e + 1 < events.size(); ++e)
    {
        const auto at = [&](std::size_t first, std::size_t end)
        {
            first = std::min(first, level.size());
            return level.subspan(first, std::min(end, level.size()) - first);
        };
        const auto in = at(events[e] - std::min(events[e], before), events[e] + after);
        const auto between = at(events[e] + after, events[e + 1] - before);
        std::vector<float> sorted(between.begin(), between.end());
        if (in.empty() || sorted.empty())
            continue;
        std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
        const auto peak = static_cast<double>(*std::max_element(in.begin(), in.end()));
        const auto rest = static_cast<double>(sorted[sorted.size() / 2]);
        sum += Decibels::fromGain((peak + 1e-9) / (std::max(rest, 0.01 * peak) + 1e-9)).value; // 40 dB is silence
    }
    return events.size() < 2 ? 0.0 : sum / static_cast<double>(events.size() - 1);
}
} // namespace detail

/// Compares both over the length of the source. The drive may be up to 20 ms late or early.
[[nodiscard]] inline LowPart compareLowPart(const HtsFeatures& source, const HtsFeatures& drive)
{
    LowPart result;
    const auto largest = [](std::span<const float> values)
    {
        return values.empty() ? 0.0f : *std::max_element(values.begin(), values.end());
    };
    const float least = 0.1f * largest(source.audible);
    if (!(least > 0.0f))
        return result;
    for (std::ptrdiff_t lag = -4; lag <= 4; ++lag)
    {
        double sum = 0.0;
        int counted = 0;
        for (std::size_t b = 0; b < source.low.size(); ++b)
            if (largest(source.low[b]) >= least)
            {
                sum += detail::correlation(source.low[b], detail::moved(drive.low[b], lag, source.low[b].size()));
                ++counted;
            }
        if (counted > 0)
            result.kept = std::max(result.kept.value_or(-1.0), sum / counted);
    }
    if (largest(source.low[0]) < least)
        return result;
    const auto events = detail::lowEvents(source.low[0]);
    const double wanted = detail::beatDepth(source.felt, events);
    if (wanted > 6.0)
        result.beat = Decibels(detail::beatDepth(drive.felt, events) - wanted).gain();
    return result;
}

} // namespace pacini
