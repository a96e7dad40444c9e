#pragma once

// Smoothing of envelopes by a Hann kernel, at any rate, with silence outside the signal.

#include <pacini/foundation/DotProduct.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

/// Returns the share of a sample's cell that lies inside a signal of `length` unit-spaced samples (which cover -0.5 to
/// length - 0.5). The cell is `spacing` wide around `position`. Coarse samples weighted by it give correct sums and
/// smoothed values at the start and end of the signal.
[[nodiscard]] inline double coverage(double position, double spacing, std::size_t length) noexcept
{
    const double begin = std::max(position - spacing / 2.0, -0.5);
    const double end = std::min(position + spacing / 2.0, static_cast<double>(length) - 0.5);
    return std::max(end - begin, 0.0) / spacing;
}

/// A symmetric, unit-sum Hann kernel whose zeros lie `halfWidth` samples from its centre (halfWidth > 0, not
/// necessarily whole): the same smoothing can so be done at different rates.
class HannKernel
{
public:
    explicit HannKernel(double halfWidth)
        : zero(halfWidth), reach(static_cast<std::size_t>(std::ceil(halfWidth)) - 1), taps(2 * reach + 1)
    {
        const auto value = [&](std::size_t i)
        {
            return 0.5 +
                   0.5 * std::cos(std::numbers::pi * (static_cast<double>(i) - static_cast<double>(reach)) / zero);
        };
        double sum = 0.0;
        for (std::size_t i = 0; i < taps.size(); ++i)
            sum += value(i);
        for (std::size_t i = 0; i < taps.size(); ++i)
            taps[i] = static_cast<float>(value(i) / sum);
    }

    /// Samples on each side of the centre that the kernel needs.
    [[nodiscard]] std::size_t reachFrames() const noexcept { return reach; }

    /// The smoothed value of x at index `centre`; samples outside of x count as zero.
    [[nodiscard]] float at(std::span<const float> x, std::size_t centre) const noexcept
    {
        const std::size_t begin = centre > reach ? centre - reach : 0;
        const std::size_t end = std::min(centre + reach + 1, x.size());
        return begin < end ? dotProduct(taps.data() + (begin + reach - centre), x.data() + begin, end - begin) : 0.0f;
    }

    /// Returns the factor that corrects at() of coarse samples close to the ends of a signal of `length` samples. The
    /// value at `position` used every `spacing`-th sample weighted by coverage(). If the kernel is only a few coarse
    /// samples long, the sum of these weights differs from the part of the kernel inside the signal. Exact for a signal
    /// that is constant within the kernel; 1 away from the ends. `position` (samples) is inside the signal.
    [[nodiscard]] double endCorrection(double position, double spacing, std::size_t length) const noexcept
    {
        double used = 0.0;
        for (std::size_t i = 0; i < taps.size(); ++i)
        {
            const double offset = (static_cast<double>(i) - static_cast<double>(reach)) * spacing;
            used += static_cast<double>(taps[i]) * coverage(position + offset, spacing, length);
        }
        const double inside = integralTo((static_cast<double>(length) - 0.5 - position) / spacing) -
                              integralTo((-0.5 - position) / spacing);
        return inside / used;
    }

private:
    /// Integral of the continuous kernel from its start to `distance` beyond its centre.
    [[nodiscard]] double integralTo(double distance) const noexcept
    {
        const double u = std::clamp(distance / zero, -1.0, 1.0);
        return 0.5 + 0.5 * u + std::sin(std::numbers::pi * u) / (2.0 * std::numbers::pi);
    }

    double zero;
    std::size_t reach;
    std::vector<float> taps;
};

} // namespace pacini
