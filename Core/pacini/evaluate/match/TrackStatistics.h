#pragma once

// Smoothing, correlation and fluctuation of heard and felt tracks.

#include <pacini/evaluate/HannSmoothing.h>
#include <pacini/evaluate/match/TouchTrack.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini::detail
{

/// A Hann kernel of the width of a Gaussian of this standard deviation.
[[nodiscard]] inline HannKernel trackKernel(double seconds)
{
    return HannKernel(seconds / 0.3615 * TouchTrack::rate);
}

/// Values before the first and after the last equal these: nothing rises or falls at the cuts of a recording.
[[nodiscard]] inline std::vector<float> smoothed(std::span<const float> x, const HannKernel& kernel)
{
    const std::size_t reach = kernel.reachFrames();
    std::vector<float> held(reach, x.front());
    held.insert(held.end(), x.begin(), x.end());
    held.resize(held.size() + reach, x.back());
    std::vector<float> y(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        y[i] = kernel.at(held, i + reach);
    return y;
}

/// The rises, frame by frame.
[[nodiscard]] inline std::vector<float> rises(std::span<const float> x)
{
    std::vector<float> y;
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
        y.push_back(std::max(0.0f, x[i + 1] - x[i]));
    return y;
}

/// Pearson's correlation with weights. `steadyX` and `steadyY` are variances that count as noise, so that nearly
/// constant values correlate with nothing. 0 if either is constant.
[[nodiscard]] inline double correlation(std::span<const float> x, std::span<const float> y,
                                        std::span<const float> weights = {}, double steadyX = 0.0, double steadyY = 0.0)
{
    const auto weight = [&](std::size_t i)
    {
        return weights.empty() ? 1.0 : static_cast<double>(weights[i]);
    };
    double total = 0.0;
    double meanX = 0.0;
    double meanY = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        total += weight(i);
        meanX += weight(i) * static_cast<double>(x[i]);
        meanY += weight(i) * static_cast<double>(y[i]);
    }
    if (!(total > 0.0))
        return 0.0;
    meanX /= total;
    meanY /= total;
    double xx = 0.0;
    double yy = 0.0;
    double xy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        const double u = static_cast<double>(x[i]) - meanX;
        const double v = static_cast<double>(y[i]) - meanY;
        xx += weight(i) * u * u;
        yy += weight(i) * v * v;
        xy += weight(i) * u * v;
    }
    const double power = (xx / total + steadyX) * (yy / total + steadyY);
    return power > 0.0 ? xy / total / std::sqrt(power) : 0.0;
}
/// Variance of unnoticeable changes: 10 % of the mean of an amplitude whose square root is `x`.
[[nodiscard]] inline double unnoticed(std::span<const float> x) noexcept
{
    double sum = 0.0;
    for (const float v : x)
        sum += static_cast<double>(v);
    const double mean = sum / static_cast<double>(x.size());
    return 0.0025 * mean * mean;
}

/// Weighted standard deviation.
[[nodiscard]] inline double deviation(std::span<const float> x, std::span<const float> weights)
{
    double total = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        const auto weight = static_cast<double>(weights[i]);
        const double v = static_cast<double>(x[i] - x[0]); // near 0: no cancellation
        total += weight;
        sum += weight * v;
        squares += weight * v * v;
    }
    return total > 0.0 ? std::sqrt(std::max(0.0, squares / total - (sum / total) * (sum / total))) : 0.0;
}

/// Root mean square of the fluctuations of `x` at 20 to 100 Hz, over some 100 ms.
[[nodiscard]] inline std::vector<float> fluctuation(std::span<const float> x)
{
    auto power = smoothed(x, trackKernel(0.0024));
    const auto coarse = smoothed(x, trackKernel(0.012));
    for (std::size_t i = 0; i < power.size(); ++i)
        power[i] = (power[i] - coarse[i]) * (power[i] - coarse[i]);
    power = smoothed(power, trackKernel(0.050));
    for (float& v : power)
        v = std::sqrt(std::max(0.0f, v));
    return power;
}

} // namespace pacini::detail
