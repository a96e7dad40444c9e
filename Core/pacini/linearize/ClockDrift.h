#pragma once

// Clock drift and lost frames between playback and recording, as a fit to measured delays.

#include <pacini/linearize/DelayTrack.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// A jump of the delay.
struct DelayStep
{
    double time = 0.0;    ///< s of the playback
    double seconds = 0.0; ///< delay, s, of everything after it; below 0 when frames are missing
};

/// Drift model: delay = drift sinceThen + the sum of the steps before it
struct DelayFit
{
    double drift = 0.0; ///< seconds of the recording more than one for each second of the playback
    std::vector<DelayStep> steps;

    /// Returns the delay, s, of the signal played at `time` s due to the steps.
    [[nodiscard]] double steppedAt(double time) const noexcept
    {
        double sum = 0.0;
        for (const DelayStep& step : steps)
            sum += time >= step.time ? step.seconds : 0.0;
        return sum;
    }
};

namespace detail
{
/// Solution of the drift equations and the error that it leaves.
struct DriftSolution
{
    Eigen::VectorXd values; // drift, then the steps
    double error = 0.0;     // weighted sum of squares
};

/// Weighted least squares of a drift and steps, from sums over all points behind each one. Weights are limited to those
/// of a deviation of 1 us: a small error of the model, such as the phase of a nonlinearity, must not count for more
/// because it is certain.
class DriftEquations
{
public:
    explicit DriftEquations(std::span<const DelayPoint> points)
        : weight(points.size() + 1, 0.0), time(points.size() + 1, 0.0), delay(points.size() + 1, 0.0)
    {
        for (std::size_t i = points.size(); i-- > 0;)
        {
            const double w = std::pow(std::max(points[i].deviation, 1e-6), -2.0);
            weight[i] = weight[i + 1] + w;
            time[i] = time[i + 1] + w * points[i].sinceThen;
            delay[i] = delay[i + 1] + w * points[i].delay;
            timeTime += w * points[i].sinceThen * points[i].sinceThen;
            timeDelay += w * points[i].sinceThen * points[i].delay;
            delayDelay += w * points[i].delay * points[i].delay;
        }
    }

    /// `splits`: for each step the index of the first point behind it.
    [[nodiscard]] DriftSolution solve(std::span<const std::size_t> splits) const
    {
        const auto unknowns = static_cast<Eigen::Index>(1 + splits.size());
        Eigen::MatrixXd normal(unknowns, unknowns);
        Eigen::VectorXd right(unknowns);
        normal(0, 0) = timeTime;
        right(0) = timeDelay;
        for (Eigen::Index i = 1; i < unknowns; ++i)
        {
            const std::size_t split = splits[static_cast<std::size_t>(i - 1)];
            normal(0, i) = normal(i, 0) = time[split];
            right(i) = delay[split];
            for (Eigen::Index k = 1; k < unknowns; ++k)
                normal(i, k) = weight[std::max(split, splits[static_cast<std::size_t>(k - 1)])];
        }
        DriftSolution solution;
        solution.values = normal.ldlt().solve(right);
        solution.error = std::max(0.0, delayDelay - right.dot(solution.values));
        return solution;
    }

private:
    std::vector<double> weight;
    std::vector<double> time;
    std::vector<double> delay;
    double timeTime = 0.0;
    double timeDelay = 0.0;
    double delayDelay = 0.0;
};

/// The points without those that stand alone: a band of much noise can find a wrong cycle of its carrier. A point stays
/// when it is near the median of the five around it, which keeps every step that lasts.
[[nodiscard]] inline std::vector<DelayPoint> withoutLoners(std::span<const DelayPoint> points)
{
    const double drift = DriftEquations(points).solve({}).values(0);
    const auto residual = [&](std::size_t i)
    {
        return points[i].delay - drift * points[i].sinceThen;
    };
    std::vector<double> distance(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const std::size_t begin = std::min(i > 2 ? i - 2 : 0, points.size() - std::min<std::size_t>(5, points.size()));
        std::vector<double> around;
        for (std::size_t k = begin; k < std::min(begin + 5, points.size()); ++k)
            around.push_back(residual(k));
        const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
        std::nth_element(around.begin(), middle, around.end());
        distance[i] = std::abs(residual(i) - *middle);
    }
    std::vector<double> sorted(distance);
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double limit = 10.0 * *middle + 1e-5;
    std::vector<DelayPoint> kept;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (distance[i] <= limit)
            kept.push_back(points[i]);
    return kept;
}
} // namespace detail

/// Fits a drift and as few steps as explain the points, which are in the order of their times. Steps are taken in one
/// by one, each where it lowers the error most, as long as it lowers it to a quarter and is at least `leastStep` s
/// (0.7 of a frame is right: frames get lost as a whole) and three points lie on both of its sides: one band that
/// found a wrong cycle is no step. Nothing without points.
[[nodiscard]] inline std::optional<DelayFit> fitDelays(std::span<const DelayPoint> measured, double leastStep)
{
    constexpr std::size_t side = 3;
    constexpr std::size_t maxSteps = 8;
    constexpr std::size_t bandReach = 4; // points from a band's centre to its end
    if (measured.empty())
        return std::nullopt;
    const auto points = detail::withoutLoners(measured);
    const detail::DriftEquations equations(points);
    std::vector<std::size_t> splits;
    auto solution = equations.solve(splits);
    while (splits.size() < maxSteps)
    {
        std::optional<detail::DriftSolution> best;
        std::vector<std::size_t> bestSplits;
        for (std::size_t i = side; i + side <= points.size(); ++i)
        {
            const auto isNear = [&](std::size_t other)
            {
                return std::max(i, other) - std::min(i, other) < side;
            };
            if (std::any_of(splits.begin(), splits.end(), isNear))
                continue;
            auto candidate = splits;
            candidate.push_back(i);
            auto with = equations.solve(candidate);
            if (!best || with.error < best->error)
            {
                best = std::move(with);
                bestSplits = std::move(candidate);
            }
        }
        if (!best || best->error > 0.25 * solution.error || std::abs(best->values(best->values.size() - 1)) < leastStep)
            break;
        solution = std::move(*best);
        splits = std::move(bestSplits);
    }
    // Bands across a step hold some of both delays and would bend the line.
    std::vector<DelayPoint> clear;
    std::vector<std::size_t> clearSplits(splits.size(), 0);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const auto across = [&](std::size_t split)
        {
            return i + bandReach >= split && i < split + bandReach;
        };
        if (std::any_of(splits.begin(), splits.end(), across))
            continue;
        for (std::size_t k = 0; k < splits.size(); ++k)
            clearSplits[k] += i < splits[k] ? 1u : 0u;
        clear.push_back(points[i]);
    }
    if (clear.size() > side * (splits.size() + 1))
        solution = detail::DriftEquations(clear).solve(clearSplits);
    DelayFit fit;
    fit.drift = solution.values(0);
    for (std::size_t k = 0; k < splits.size(); ++k)
        fit.steps.push_back({0.5 * (points[splits[k] - 1].time + points[splits[k]].time),
                             solution.values(static_cast<Eigen::Index>(k + 1))});
    std::sort(fit.steps.begin(), fit.steps.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    return fit;
}

} // namespace pacini
