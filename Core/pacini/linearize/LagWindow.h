#pragma once

// Lag window: cuts out the part of an impulse response that belongs to one thing.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

/// 1 from flatBegin to flatEnd, raised cosines to 0 at begin and end; lags in s.
struct LagWindow
{
    double begin = 0.0;
    double flatBegin = 0.0;
    double flatEnd = 0.0;
    double end = 0.0;

    [[nodiscard]] double at(double lag) const noexcept
    {
        const auto rise = [](double part)
        {
            return 0.5 - 0.5 * std::cos(std::numbers::pi * part);
        };
        if (!(lag > begin && lag < end))
            return 0.0;
        if (lag < flatBegin)
            return rise((lag - begin) / (flatBegin - begin));
        return lag > flatEnd ? rise((end - lag) / (end - flatEnd)) : 1.0;
    }

    /// The window whose sides take the given part, 0 to 0.5, of its whole length each.
    [[nodiscard]] static LagWindow withSides(double begin, double end, double part) noexcept
    {
        const double side = part * (end - begin);
        return {begin, begin + side, end - side, end};
    }
};

/// A piece of an impulse response.
struct ResponseCut
{
    std::ptrdiff_t firstLag = 0; ///< samples from the arrival to samples[0]
    std::vector<double> samples;
    double windowEnergy = 0.0; ///< sum of the squared window
};

/// The windowed part of a circular response at `rate` Hz.
[[nodiscard]] inline ResponseCut cutResponse(std::span<const double> circular, double rate, const LagWindow& window)
{
    ResponseCut cut;
    cut.firstLag = static_cast<std::ptrdiff_t>(std::ceil(window.begin * rate));
    const auto last = static_cast<std::ptrdiff_t>(std::floor(window.end * rate));
    const auto size = static_cast<std::ptrdiff_t>(circular.size());
    for (std::ptrdiff_t lag = cut.firstLag; lag <= last; ++lag)
    {
        const double w = window.at(static_cast<double>(lag) / rate);
        cut.samples.push_back(w * circular[static_cast<std::size_t>(((lag % size) + size) % size)]);
        cut.windowEnergy += w * w;
    }
    return cut;
}

} // namespace pacini
