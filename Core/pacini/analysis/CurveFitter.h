#pragma once

// Curve fitting at a price per point: dense tracks of the analysis -> breakpoints.

#include <pacini/clip/Curve.h>
#include <pacini/simplify/Lagrangian.h>
#include <pacini/simplify/Refit.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Turns evenly sampled tracks into curves with the fewest points that are worth their price: the price of a point is
/// the summed squared error that it must save. A workspace, so that curve after curve costs no allocation. One thread
/// at a time.
class CurveFitter
{
    static constexpr double decibelsPerNeper = 8.685889638065035;
    static constexpr double semitonesPerNeper = 17.312340490667562;

public:
    /// Amplitudes, sample i at i * step seconds. Errors are relative, in dB^2 per sample, and fade out below `floor`
    /// (linear): what nobody feels is not worth a point. Values that stay a quarter below the floor become 0. An
    /// all-zero track gives an empty curve. Errors count up to 5.5 times where `heardShare` (0-1 of each sample, or
    /// none) is large: loudness moves by less than levels of bands do, and its small steps are heard.
    [[nodiscard]] Curve fitAmplitude(std::span<const float> track, double step, double gain, double floor, double price,
                                     std::span<const float> heardShare = {})
    {
        const AmplitudeSamples levels{track, heardShare, gain, floor};
        const auto audible = [&levels](std::size_t i)
        {
            return levels.value(i) > 0.0;
        };
        std::size_t first = 0;
        while (first < levels.size() && !audible(first))
            ++first;
        if (first == levels.size())
            return {};
        Curve curve = fit(amplitudes, levels, step, price);
        for (Breakpoint& point : curve)
            if (point.value < 0.25 * floor)
                point.value = 0.0;
        return curve;
    }

    /// Frequencies in Hz with the importance (0-1) of each sample; errors are in semitones^2. One point where the
    /// track is not worth more; an empty curve where nothing is important.
    [[nodiscard]] Curve fitPitch(std::span<const double> track, std::span<const double> importance, double step,
                                 double price)
    {
        double most = 0.0;
        for (double i : importance)
            most = std::max(most, i);
        if (!(most > 0.0))
            return {};
        double sum = 0.0;
        double weightSum = 0.0;
        values.assign(track.begin(), track.end());
        weights.resize(track.size());
        for (std::size_t i = 0; i < track.size(); ++i)
        {
            // A trace of importance everywhere, or nothing would hold the curve where the sound is silent.
            const double perHertz = semitonesPerNeper / track[i];
            weights[i] = std::max(importance[i], 1e-4 * most) * perHertz * perHertz;
            sum += weights[i] * track[i];
            weightSum += weights[i];
        }
        const double mean = sum / weightSum;
        double constantError = 0.0;
        for (std::size_t i = 0; i < track.size(); ++i)
            constantError += weights[i] * (track[i] - mean) * (track[i] - mean);
        if (track.size() < 3 || constantError < price)
            return {{0.0, mean}};
        Curve curve = fit(pitches, samples(), step, price);
        const double saved = constantError - squaredError(samples(), kept);
        if (saved < price * static_cast<double>(curve.size() - 1))
            return {{0.0, mean}};
        return curve;
    }

private:
    /// Levels and their weights, worked out from the track whenever they are asked for: an hour of envelope would be 23
    /// MB otherwise.
    struct AmplitudeSamples
    {
        std::span<const float> track, heardShare;
        double gain = 1.0, floor = 0.0;

        [[nodiscard]] std::size_t size() const noexcept { return track.size(); }
        [[nodiscard]] double level(std::size_t i) const noexcept { return gain * static_cast<double>(track[i]); }
        [[nodiscard]] double value(std::size_t i) const noexcept
        {
            const double a = level(i);
            return a < 0.25 * floor ? 0.0 : a;
        }
        [[nodiscard]] double time(std::size_t i) const noexcept { return static_cast<double>(i); }
        [[nodiscard]] double weight(std::size_t i) const noexcept
        {
            const double a = level(i);
            const double worth = heardShare.empty() ? 1.0 : 1.0 + 4.5 * static_cast<double>(heardShare[i]);
            return worth * decibelsPerNeper * decibelsPerNeper / (a * a + floor * floor);
        }
        [[nodiscard]] bool evenlySpaced() const noexcept { return true; }
        [[nodiscard]] bool weighted() const noexcept { return true; }
    };

    /// Samples as points, one every `step` s.
    template <Samples S>
    struct Points
    {
        S samples;
        double step = 1.0;

        [[nodiscard]] std::size_t size() const noexcept { return samples.size(); }
        [[nodiscard]] Breakpoint operator[](std::size_t i) const noexcept
        {
            return {static_cast<double>(i) * step, samples.value(i)};
        }
    };

    [[nodiscard]] DenseSamples samples() const { return {values, {}, weights}; }

    template <Samples S>
    Curve fit(LagrangianSegmenterOf<S>& segmenter, const S& from, double step, double price)
    {
        segmenter.solve(from, price, kept);
        const Points<S> dense{from, step};
        Curve vertices;
        vertices.reserve(kept.size());
        for (const std::size_t i : kept)
            vertices.push_back(dense[i]);
        RefitParams params;
        params.lowest = 0.0;
        return refitTo(
            dense, vertices, [&from](std::size_t i) { return from.weight(i); }, params);
    }

    LagrangianSegmenterOf<AmplitudeSamples> amplitudes{128};
    LagrangianSegmenter pitches{128};
    KeptPoints kept;
    std::vector<double> values, weights; // of a pitch track
};

} // namespace pacini
