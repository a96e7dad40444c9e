#pragma once

// A dense curve as contiguous columns, and its squared vertical errors, for the squared-error simplifiers.

#include <pacini/clip/Curve.h>

#include <cassert>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Views of a dense curve. `times` empty means evenly spaced samples (time = index); `weights` empty means 1 each.
/// Where present, they are as long as `values`; times do not decrease, weights are 0 or more, all are finite.
struct DenseSamples
{
    std::span<const double> values;
    std::span<const double> times;
    std::span<const double> weights;

    [[nodiscard]] std::size_t size() const noexcept { return values.size(); }
    [[nodiscard]] double value(std::size_t i) const noexcept { return values[i]; }
    [[nodiscard]] double time(std::size_t i) const noexcept
    {
        return times.empty() ? static_cast<double>(i) : times[i];
    }
    [[nodiscard]] double weight(std::size_t i) const noexcept { return weights.empty() ? 1.0 : weights[i]; }
    [[nodiscard]] bool evenlySpaced() const noexcept { return times.empty(); }
    [[nodiscard]] bool weighted() const noexcept { return !weights.empty(); }
};

/// Concept of a dense curve for the squared-error simplifiers: DenseSamples, or samples computed on demand, which take
/// no memory; repeated calls give the same number.
template <typename S>
concept Samples = requires(const S& samples, std::size_t i)
{
    {
        samples.size()
        } -> std::convertible_to<std::size_t>;
    {
        samples.value(i)
        } -> std::convertible_to<double>;
    {
        samples.time(i)
        } -> std::convertible_to<double>;
    {
        samples.weight(i)
        } -> std::convertible_to<double>;
    {
        samples.evenlySpaced()
        } -> std::convertible_to<bool>;
    {
        samples.weighted()
        } -> std::convertible_to<bool>;
};

/// The slope of the line through samples i and j; 0 for a vertical step, whose line stands at sample i's value.
template <Samples S>
[[nodiscard]] double chordSlope(const S& samples, std::size_t i, std::size_t j) noexcept
{
    const double span = samples.time(j) - samples.time(i);
    return span != 0.0 ? (samples.value(j) - samples.value(i)) / span : 0.0;
}

/// Weighted sum of squared vertical errors of the samples strictly between i and j against the line i-j. O(j - i).
[[nodiscard]] inline double squaredError(const DenseSamples& samples, std::size_t i, std::size_t j) noexcept
{
    const double slope = chordSlope(samples, i, j);
    double sum = 0.0;
    for (std::size_t m = i + 1; m < j; ++m)
    {
        const double error = samples.values[m] - samples.values[i] - slope * (samples.time(m) - samples.time(i));
        sum += samples.weight(m) * error * error;
    }
    return sum;
}

/// The same for all segments of a simplification; `kept` ascending, from the first to the last sample. O(n).
[[nodiscard]] inline double squaredError(const DenseSamples& samples, std::span<const std::size_t> kept) noexcept
{
    double sum = 0.0;
    for (std::size_t k = 1; k < kept.size(); ++k)
        sum += squaredError(samples, kept[k - 1], kept[k]);
    return sum;
}

/// Owns the columns of a curve given as breakpoints; times are left out when they are evenly spaced to 1e-6 of a step.
class DenseColumns
{
public:
    explicit DenseColumns(std::span<const Breakpoint> curve)
    {
        values.reserve(curve.size());
        for (const Breakpoint& p : curve)
            values.push_back(p.value);
        if (evenlySpaced(curve))
            return;
        times.reserve(curve.size());
        for (const Breakpoint& p : curve)
            times.push_back(p.time);
    }

    [[nodiscard]] DenseSamples samples() const noexcept { return {values, times, {}}; }

private:
    static bool evenlySpaced(std::span<const Breakpoint> curve) noexcept
    {
        if (curve.size() < 3)
            return true;
        const double step = (curve.back().time - curve.front().time) / static_cast<double>(curve.size() - 1);
        for (std::size_t i = 0; i < curve.size(); ++i)
        {
            const double off = curve[i].time - curve.front().time - step * static_cast<double>(i);
            if (!(off <= 1e-6 * step && off >= -1e-6 * step))
                return false;
        }
        return step > 0.0;
    }

    std::vector<double> values;
    std::vector<double> times;
};

} // namespace pacini
