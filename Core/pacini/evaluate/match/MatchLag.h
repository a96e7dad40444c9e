#pragma once

// Lag of a vibration behind its sound, and compensation of the lag.

#include <pacini/evaluate/match/HeardTrack.h>
#include <pacini/evaluate/match/TouchTrack.h>
#include <pacini/evaluate/match/TrackStatistics.h>
#include <pacini/foundation/DotProduct.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <type_traits>
#include <vector>

namespace pacini
{

namespace detail
{
/// Less its mean, at length 1.
[[nodiscard]] inline std::vector<float> normalised(std::vector<float> x)
{
    const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
    double power = 0.0;
    for (float& v : x)
    {
        v = static_cast<float>(static_cast<double>(v) - mean);
        power += static_cast<double>(v) * static_cast<double>(v);
    }
    const double scale = power > 0.0 ? 1.0 / std::sqrt(power) : 0.0;
    for (float& v : x)
        v = static_cast<float>(scale * static_cast<double>(v));
    return x;
}
} // namespace detail

/// Returns the delay of the felt signal, in frames (1/500 s), within +-100 ms; negative if it is early. It is the lag
/// with the best correlation of the rises of both. It is 0 unless that correlation is at least .5 and exceeds the
/// correlation without a lag by .2: steady sounds have no definite lag, trains of pulses have many. Sounds of less than
/// .2 s have 0.
[[nodiscard]] inline int matchLag(const HeardTrack& heard, const TouchTrack& felt)
{
    constexpr std::ptrdiff_t reach = 50;
    constexpr double better = 0.2;
    constexpr double certain = 0.5;
    const std::ptrdiff_t size = std::ssize(heard.loudness) - std::ptrdiff_t{detail::loudnessDelay};
    if (size < 2 * reach || std::ssize(felt.strength) < 2)
        return 0;
    const HannKernel kernel = detail::trackKernel(0.010);
    const auto risesOf = [&](std::span<const float> x)
    {
        std::vector<float> y(x.size());
        std::transform(x.begin(), x.end(), y.begin(), [](float v) { return std::sqrt(v); });
        return detail::normalised(detail::rises(detail::smoothed(y, kernel)));
    };
    const auto a = risesOf(std::span(heard.loudness).subspan(detail::loudnessDelay));
    const auto b = risesOf(felt.strength);
    const auto correlationAt = [&](std::ptrdiff_t lag)
    {
        const std::ptrdiff_t first = std::max<std::ptrdiff_t>(0, -lag);
        const std::ptrdiff_t end = std::min(std::ssize(a), std::ssize(b) - lag);
        return end > first ? dotProductIn<double>(a.data() + first, b.data() + first + lag,
                                                  static_cast<std::size_t>(end - first))
                           : 0.0;
    };
    std::ptrdiff_t best = 0;
    double most = std::max(certain, correlationAt(0) + better);
    for (std::ptrdiff_t lag = -reach; lag <= reach; ++lag)
        if (const double c = correlationAt(lag); c > most)
        {
            most = c;
            best = lag;
        }
    return static_cast<int>(best);
}

/// The felt signal, `frames` (1/500 s) earlier; frequencies by the nearest of their frames.
[[nodiscard]] inline TouchTrack earlier(TouchTrack felt, int frames)
{
    const auto move = [](auto& values, int count)
    {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        if (count > 0)
            values.erase(values.begin(), values.begin() + std::min<std::ptrdiff_t>(count, std::ssize(values)));
        else
            values.insert(values.begin(), static_cast<std::size_t>(-count), Value{});
    };
    const auto steps = static_cast<int>(std::lround(frames / (TouchTrack::frameSeconds * TouchTrack::rate)));
    move(felt.strength, frames);
    move(felt.octave, steps);
    move(felt.power, steps);
    return felt;
}

} // namespace pacini
