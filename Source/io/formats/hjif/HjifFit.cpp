#include "io/formats/hjif/HjifFit.h"

#include <pacini/foundation/SizeInMemory.h>
#include <pacini/simplify/Lagrangian.h>
#include <pacini/simplify/Refit.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

namespace pacini
{

namespace
{
constexpr double decibelsPerNeper = 8.685889638065035;
constexpr double masked = 0.15; // of the sum, -16 dB: errors of bands below that are felt less

/// Root mean squares around each step.
std::vector<double> sampled(const Curve& amplitude, double duration, std::size_t steps)
{
    constexpr int around = 2;      // to each side
    constexpr double fine = 0.001; // s
    std::vector<double> track;
    CurveReader reader(amplitude);
    for (std::size_t i = 0; i < steps; ++i)
    {
        double power = 0.0;
        for (int k = -around; k <= around; ++k)
        {
            const double time = static_cast<double>(i) * HjifFit::step + k * fine;
            power += std::pow(reader.at(std::clamp(time, 0.0, duration)), 2.0) / (2 * around + 1);
        }
        track.push_back(std::sqrt(power));
    }
    return track;
}

/// Points at steps, which are samples of a track.
struct StepPoints
{
    const std::vector<double>& values;

    [[nodiscard]] std::size_t size() const noexcept { return values.size(); }
    [[nodiscard]] Breakpoint operator[](std::size_t i) const noexcept
    {
        return {static_cast<double>(i) * HjifFit::step, values[i]};
    }
};

double dot(std::span<const double> a, std::span<const double> b)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

/// Values of curves whose points lie on steps, as one list of unknowns.
class Unknowns
{
public:
    explicit Unknowns(const std::vector<Curve>& curves)
    {
        for (const Curve& curve : curves)
        {
            first.push_back(values.size());
            for (const Breakpoint& point : curve)
            {
                values.push_back(point.value);
                places.push_back(static_cast<std::size_t>(std::llround(point.time / HjifFit::step)));
            }
        }
        first.push_back(values.size());
    }

    /// Values of one curve at every step.
    void spread(std::size_t curve, std::span<const double> x, std::span<double> steps) const
    {
        std::fill(steps.begin(), steps.end(), 0.0);
        for (std::size_t k = first[curve]; k < first[curve + 1]; ++k)
        {
            const bool last = k + 1 == first[curve + 1];
            const std::size_t from = places[k], to = last ? from + 1 : places[k + 1];
            for (std::size_t i = from; i < to; ++i)
            {
                const double place = static_cast<double>(i - from) / static_cast<double>(to - from);
                steps[i] = x[k] + (last ? 0.0 : place * (x[k + 1] - x[k]));
            }
        }
    }

    /// The transpose of spread().
    void gather(std::size_t curve, std::span<const double> steps, std::span<double> x) const
    {
        for (std::size_t k = first[curve]; k < first[curve + 1]; ++k)
            x[k] = 0.0;
        for (std::size_t k = first[curve]; k < first[curve + 1]; ++k)
        {
            const bool last = k + 1 == first[curve + 1];
            const std::size_t from = places[k], to = last ? from + 1 : places[k + 1];
            for (std::size_t i = from; i < to; ++i)
            {
                const double place = static_cast<double>(i - from) / static_cast<double>(to - from);
                x[k] += (1.0 - place) * steps[i];
                if (!last)
                    x[k + 1] += place * steps[i];
            }
        }
    }

    std::vector<double> values;

private:
    std::vector<std::size_t> first, places;
};
} // namespace

HjifFit::HjifFit(const Clip& clip, double leastFelt, bool joint)
    : duration(clip.duration),
      floor(leastFelt),
      count(static_cast<std::size_t>(std::floor(clip.duration / step)) + 1),
      sums(count)
{
    for (const Band& band : clip.bands)
    {
        levels.push_back(sampled(band.amplitude, duration, count));
        for (std::size_t i = 0; i < count; ++i)
            sums[i] = std::hypot(sums[i], levels.back()[i]);
    }
    if (joint)
        multiplyWaves(clip);
}

HjifFit::Products& HjifFit::products(std::size_t interval, std::size_t a, std::size_t b)
{
    return pairs[(interval * levels.size() + a) * levels.size() + b];
}

const HjifFit::Products& HjifFit::products(std::size_t interval, std::size_t a, std::size_t b) const
{
    return pairs[(interval * levels.size() + a) * levels.size() + b];
}

void HjifFit::multiplyWaves(const Clip& clip)
{
    constexpr std::size_t perStep = 20; // samples: bands of up to 2 kHz
    constexpr double sample = step / perStep;
    const std::size_t n = clip.bands.size();
    pairs.resize(sizeInMemory(std::uint64_t{count} * n * n));
    wanted.assign(n, std::vector<double>(count));
    std::vector<CurveReader> pitches, amplitudes;
    for (const Band& band : clip.bands)
    {
        pitches.emplace_back(band.pitch);
        amplitudes.emplace_back(band.amplitude);
    }
    std::vector<double> cycles, waves(n);
    for (const Band& band : clip.bands)
        cycles.push_back(band.phase);
    for (std::size_t interval = 0; interval + 1 < count; ++interval)
    {
        const double level = std::hypot(floor, sums[interval]);
        for (std::size_t k = 0; k < perStep; ++k)
        {
            const double time = static_cast<double>(interval) * step + static_cast<double>(k) * sample;
            double whole = 0.0;
            for (std::size_t a = 0; a < n; ++a)
            {
                waves[a] = std::sin(2.0 * std::numbers::pi * cycles[a]);
                whole += amplitudes[a].at(time) * waves[a];
                cycles[a] += pitches[a].at(time + 0.5 * sample) * sample;
                cycles[a] -= std::floor(cycles[a]);
            }
            const double place = static_cast<double>(k) / perStep, rest = 1.0 - place;
            const double weight = 1.0 / (level * level);
            for (std::size_t a = 0; a < n; ++a)
            {
                const double weighted = weight * waves[a];
                wanted[a][interval] += rest * weighted * whole;
                wanted[a][interval + 1] += place * weighted * whole;
                for (std::size_t b = 0; b < n; ++b)
                {
                    Products& product = products(interval, a, b);
                    const double both = weighted * waves[b];
                    product.first += static_cast<float>(rest * rest * both);
                    product.mixed += static_cast<float>(rest * place * both);
                    product.second += static_cast<float>(place * place * both);
                }
            }
        }
    }
}

Curve HjifFit::separately(std::size_t band, double price, std::span<const double> need) const
{
    std::vector<double> values(count), weights(count);
    for (std::size_t i = 0; i < count; ++i)
    {
        const double level = levels[band][i];
        const double sum = masked * sums[i];
        values[i] = level < 0.25 * floor ? 0.0 : level;
        weights[i] = need[i] * decibelsPerNeper * decibelsPerNeper / (level * level + floor * floor + sum * sum);
    }
    if (std::all_of(values.begin(), values.end(), [](double value) { return value == 0.0; }))
        return {};
    LagrangianSegmenter segmenter{128};
    KeptPoints kept;
    segmenter.solve(DenseSamples{values, {}, weights}, price, kept);
    const StepPoints dense{values};
    Curve vertices;
    for (const std::size_t i : kept)
        vertices.push_back(dense[i]);
    RefitParams params;
    params.lowest = 0.0;
    Curve curve = refitTo(
        dense, vertices, [&](std::size_t i) { return weights[i]; }, params);
    for (Breakpoint& point : curve)
        if (point.value < 0.25 * floor)
            point.value = 0.0;
    return curve;
}

/// Conjugate gradients on the normal equations, from the values that each has by itself (M. Hestenes and E. Stiefel,
/// "Methods of conjugate gradients for solving linear systems", 1952), scaled by the diagonal. A few steps are enough:
/// what is left then is hardly determined.
void HjifFit::together(std::vector<Curve>& curves) const
{
    constexpr int iterations = 10;
    const std::size_t n = curves.size();
    Unknowns unknowns(curves);
    std::vector<double>& x = unknowns.values;
    std::vector<bool> isFree(x.size());
    for (std::size_t k = 0; k < x.size(); ++k)
        isFree[k] = x[k] > 0.0;
    std::vector<std::vector<double>> spread(n, std::vector<double>(count));
    std::vector<double> product(count);
    const auto normal = [&](std::span<const double> from, std::span<double> to)
    {
        for (std::size_t a = 0; a < n; ++a)
            unknowns.spread(a, from, spread[a]);
        for (std::size_t a = 0; a < n; ++a)
        {
            std::fill(product.begin(), product.end(), 0.0);
            for (std::size_t i = 0; i + 1 < count; ++i)
                for (std::size_t b = 0; b < n; ++b)
                {
                    const Products& p = products(i, a, b);
                    product[i] +=
                        static_cast<double>(p.first) * spread[b][i] + static_cast<double>(p.mixed) * spread[b][i + 1];
                    product[i + 1] +=
                        static_cast<double>(p.mixed) * spread[b][i] + static_cast<double>(p.second) * spread[b][i + 1];
                }
            unknowns.gather(a, product, to);
        }
        for (std::size_t k = 0; k < to.size(); ++k)
            if (!isFree[k])
                to[k] = 0.0;
    };
    std::vector<double> diagonal(x.size()), residual(x.size()), scaled(x.size()), changed(x.size());
    for (std::size_t a = 0; a < n; ++a)
    {
        // Only near the diagonal, but all that it does is scale.
        for (std::size_t i = 0; i < count; ++i)
            product[i] = static_cast<double>(products(i, a, a).first) +
                         static_cast<double>(i > 0 ? products(i - 1, a, a).second : 0.0f);
        unknowns.gather(a, product, diagonal);
        unknowns.gather(a, wanted[a], residual);
    }
    normal(x, changed);
    for (std::size_t k = 0; k < x.size(); ++k)
    {
        residual[k] = isFree[k] ? residual[k] - changed[k] : 0.0;
        diagonal[k] = std::max(diagonal[k], 1e-9);
        scaled[k] = residual[k] / diagonal[k];
    }
    std::vector<double> direction = scaled;
    double left = dot(residual, scaled);
    for (int i = 0; i < iterations && left > 1e-12; ++i)
    {
        normal(direction, changed);
        const double curvature = dot(direction, changed);
        if (!(curvature > 0.0))
            break;
        const double length = left / curvature;
        for (std::size_t k = 0; k < x.size(); ++k)
        {
            x[k] += length * direction[k];
            residual[k] -= length * changed[k];
            scaled[k] = residual[k] / diagonal[k];
        }
        const double before = std::exchange(left, dot(residual, scaled));
        for (std::size_t k = 0; k < x.size(); ++k)
            direction[k] = scaled[k] + left / before * direction[k];
    }
    std::size_t k = 0;
    for (Curve& curve : curves)
        for (Breakpoint& point : curve)
            point.value = std::max(x[k++], 0.0);
}

std::vector<Curve> HjifFit::curves(double price, std::span<const double> need) const
{
    std::vector<Curve> fitted;
    for (std::size_t band = 0; band < levels.size(); ++band)
        fitted.push_back(separately(band, price, need));
    if (!pairs.empty())
        together(fitted);
    for (Curve& curve : fitted)
        for (Breakpoint& point : curve)
            point.value = std::min(point.value, limits::amplitude);
    return fitted;
}

} // namespace pacini
