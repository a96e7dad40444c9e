#pragma once

// Dense tracks of the analysis -> breakpoints, at a price per point.

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
public:
    /// Amplitudes, sample i at i * step seconds. Errors are relative, in dB^2 per sample, and fade out below `floor`
    /// (linear): what nobody feels is not worth a point. Values that stay a quarter below the floor become 0. An
    /// all-zero track gives an empty curve.
    [[nodiscard]] Curve fitAmplitude(std::span<const float> track, double step, double gain, double floor, double price)
    {
        bool audible = false;
        values.resize(track.size());
        weights.resize(track.size());
        for (std::size_t i = 0; i < track.size(); ++i)
        {
            const double a = gain * static_cast<double>(track[i]);
            values[i] = a < 0.25 * floor ? 0.0 : a;
            audible = audible || values[i] > 0.0;
            weights[i] = decibelsPerNeper * decibelsPerNeper / (a * a + floor * floor);
        }
        if (!audible)
            return {};
        Curve curve = fit(step, price);
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
        Curve curve = fit(step, price);
        const double saved = constantError - squaredError(samples(), kept);
        if (saved < price * static_cast<double>(curve.size() - 1))
            return {{0.0, mean}};
        return curve;
    }

private:
    static constexpr double decibelsPerNeper = 8.685889638065035;
    static constexpr double semitonesPerNeper = 17.312340490667562;

    [[nodiscard]] DenseSamples samples() const { return {values, {}, weights}; }

    Curve fit(double step, double price)
    {
        segmenter.solve(samples(), price, kept);
        dense.resize(values.size());
        for (std::size_t i = 0; i < values.size(); ++i)
            dense[i] = {static_cast<double>(i) * step, values[i]};
        RefitParams params;
        params.lowest = 0.0;
        return refit(dense, curveOf(dense, kept), weights, params);
    }

    LagrangianSegmenter segmenter{128};
    KeptPoints kept;
    std::vector<double> values, weights;
    Curve dense;
};

} // namespace pacini
