#pragma once

// Least-squares problem of an equalizer fit: a frequency response as its points and weights.

#include <pacini/linearize/EqualizerCurve.h>
#include <pacini/linearize/EqualizerFitParams.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace pacini
{

namespace detail
{

/// The standard deviation of noise on a smooth curve of at least 4 points: that of its third differences, which is
/// sqrt(20) times as large, from the median of their magnitudes, which drop-outs do not move (difference-based
/// estimation: P. Hall, J. W. Kay, D. M. Titterington, "Asymptotically optimal difference-based estimation of variance
/// in nonparametric regression", 1990; median: F. R. Hampel, "The influence curve and its role in robust estimation",
/// 1974).
[[nodiscard]] inline double noiseOf(const std::vector<double>& level)
{
    constexpr double medianToDeviation = 1.4826; // of a normal distribution
    std::vector<double> sizes;
    for (std::size_t i = 3; i < level.size(); ++i)
        sizes.push_back(std::abs((level[i] - level[i - 3]) - 3.0 * (level[i - 1] - level[i - 2])));
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return medianToDeviation * *middle / std::sqrt(20.0);
}

/// Marks runs of up to four points that jump away from the one before them and then come back to it, all by more than 6
/// dB and five times the noise. A resonance wide enough for its points to show it (see the largest q of a fit) changes
/// by less than 5 dB from one to the next; where there are fewer than 64 points it may be narrower, so that more is
/// asked there in proportion.
[[nodiscard]] inline std::vector<bool> dropoutsOf(const std::vector<double>& level, double noise)
{
    constexpr std::size_t longest = 4;
    const std::size_t n = level.size();
    const double threshold = 6.0 * std::max(1.0, 64.0 / static_cast<double>(n)) + 5.0 * noise; // dB
    std::vector<bool> dropouts(n, false);
    const auto scan = [&](const auto& index)
    {
        const auto apart = [&](std::size_t i, std::size_t j)
        {
            return std::abs(level[index(j)] - level[index(i)]) > threshold;
        };
        for (std::size_t i = 0; i + 1 < n;)
        {
            std::size_t end = i + 1;
            while (end < n && end <= i + longest && apart(i, end))
                ++end;
            const bool back = end == n || !apart(i, end);
            for (std::size_t j = i + 1; back && j < end; ++j)
                dropouts[index(j)] = true;
            i = back ? end : i + 1;
        }
    };
    // A run at the very start has no point before it: the other direction finds it.
    bool startsApart = false;
    for (std::size_t i = 1; i <= longest && i < n; ++i)
        startsApart = startsApart || std::abs(level[i] - level[0]) > threshold;
    if (startsApart)
        scan([n](std::size_t i) { return n - 1 - i; });
    else
        scan([](std::size_t i) { return i; });
    return dropouts;
}

} // namespace detail

/// The points in the range come first, then guard points, at which only the boost is watched.
struct EqualizerFitProblem
{
    double fs = 48000.0;
    std::optional<EqualizerSection> highpass;
    double maxBoost = 12.0; ///< dB
    bool boostOutside = false;
    bool shelves = true;
    double lowestFrequency = 1.0; ///< Hz, of sections
    double highestFrequency = 20000.0;
    double lowestQ = 0.1;
    double highestQ = 60.0;

    std::vector<double> frequency; ///< Hz, all points
    std::vector<double> warped;    ///< warpedSquare() of them
    std::vector<double> fixed;     ///< dB, the high-pass at them
    std::vector<double> level;     ///< dB, response and high-pass, the points in the range only
    std::vector<double> given;     ///< the weights as given, scaled to a mean of 1
    std::vector<double> weight;    ///< 0 for drop-outs
    std::size_t dropouts = 0;
    double noise = 0.0;                                       ///< dB, standard deviation from point to point
    double outlier = std::numeric_limits<double>::infinity(); ///< dB, where the loss ceases to be a square

    [[nodiscard]] std::size_t points() const noexcept { return level.size(); } ///< in the range
    [[nodiscard]] std::size_t allPoints() const noexcept { return warped.size(); }
    [[nodiscard]] double highestGuard() const noexcept { return 0.4999 * fs; }

    /// The level of the high-pass, dB.
    [[nodiscard]] double fixedAt(double f) const { return highpass ? equalizerLevel({*highpass}, f, fs) : 0.0; }

    void addFrequency(double f)
    {
        frequency.push_back(f);
        warped.push_back(warpedSquare(f, fs));
        fixed.push_back(fixedAt(f));
    }
    void addPoint(double f, double dB, double givenWeight)
    {
        addFrequency(f);
        level.push_back(dB + fixed.back());
        given.push_back(givenWeight);
    }
    void addGuard(double f)
    {
        if (f < highestGuard())
            addFrequency(f);
    }
};

namespace detail
{

/// Six octaves to both sides of the points, dense where sections may lie, and between points that are far apart.
inline void addGuards(EqualizerFitProblem& problem)
{
    const std::size_t n = problem.points();
    const double first = problem.frequency[0];
    const double last = problem.frequency[n - 1];
    constexpr double fine = 1.0 / 24.0, middle = 1.0 / 8.0, coarse = 1.0 / 2.0; // octaves
    for (double octaves = fine; octaves <= 6.0; octaves += octaves < 0.5 ? fine : (octaves < 1.5 ? middle : coarse))
    {
        problem.addGuard(first * std::exp2(-octaves));
        problem.addGuard(last * std::exp2(octaves));
    }
    for (std::size_t i = 0; i + 1 < n; ++i)
        for (double at = problem.frequency[i] * std::exp2(middle); at < problem.frequency[i + 1];
             at *= std::exp2(middle))
            problem.addGuard(at);
}

inline void boundSections(EqualizerFitProblem& problem)
{
    const double first = problem.frequency[0];
    const double last = problem.frequency[problem.points() - 1];
    problem.lowestFrequency = std::max(1.0, 0.5 * first);
    problem.highestFrequency = std::min({2.0 * last, 0.48 * problem.fs, 20000.0});
    // The half-height width of a peak, f / q, is at least 1.4 times the distance of the points.
    const double distance = std::log(last / first) / static_cast<double>(problem.points() - 1);
    problem.highestQ = std::clamp(0.7 / distance, 2.0, 60.0);
}

/// Weights of mean 1; drop-outs lose theirs, unless too few points would remain.
inline void weigh(EqualizerFitProblem& problem, double sum)
{
    for (double& weight : problem.given)
        weight *= static_cast<double>(problem.points()) / sum;
    problem.weight = problem.given;
    problem.noise = noiseOf(problem.level);
    const std::vector<bool> dropouts = dropoutsOf(problem.level, problem.noise);
    std::size_t counted = 0, dropped = 0;
    for (std::size_t i = 0; i < problem.points(); ++i)
    {
        if (dropouts[i])
            ++dropped;
        else if (problem.given[i] > 0.0)
            ++counted;
    }
    if (dropped == 0 || counted < FrequencyResponse::fewestPoints)
        return;
    problem.dropouts = dropped;
    for (std::size_t i = 0; i < problem.points(); ++i)
        if (dropouts[i])
            problem.weight[i] = 0.0;
}

} // namespace detail

/// Checks response and parameters and takes the points in the range and below 0.49 of the sample rate.
[[nodiscard]] inline Result<EqualizerFitProblem> makeEqualizerFitProblem(const FrequencyResponse& response,
                                                                         const EqualizerFitParams& params)
{
    if (auto valid = validate(response, params); !valid)
        return valid.error();
    EqualizerFitProblem problem;
    problem.fs = params.sampleRate;
    problem.highpass = params.highpass;
    problem.maxBoost = params.maxBoost;
    problem.boostOutside = params.boostOutside;
    problem.shelves = params.shelves;
    const double low = params.lowFrequency > 0.0 ? params.lowFrequency : response.frequency.front();
    const double high = params.highFrequency > 0.0 ? params.highFrequency : response.frequency.back();
    std::size_t counted = 0;
    double sum = 0.0;
    for (std::size_t i = 0; i < response.size(); ++i)
    {
        const double f = response.frequency[i];
        if (f < low || f > high || f >= 0.49 * problem.fs)
            continue;
        const double weight = params.weights.empty() ? 1.0 : params.weights[i];
        problem.addPoint(f, response.level[i], weight);
        if (weight > 0.0)
            ++counted;
        sum += weight;
    }
    if (counted < FrequencyResponse::fewestPoints)
    {
        const char* where = problem.points() >= FrequencyResponse::fewestPoints ? "weights"
                            : params.lowFrequency > 0.0                         ? "lowFrequency"
                            : params.highFrequency > 0.0                        ? "highFrequency"
                                                                                : "sampleRate";
        return Error{ErrorCode::invalidArgument, where,
                     "leaves fewer than 8 points to fit to; points from 0.49 of the sample rate on do not count"};
    }
    detail::weigh(problem, sum);
    detail::boundSections(problem);
    detail::addGuards(problem);
    return problem;
}

/// The same with the weighted means of the points over at most 1024 steps of equal ratio, if there are more points.
[[nodiscard]] inline EqualizerFitProblem thinned(const EqualizerFitProblem& problem)
{
    constexpr double most = 1024.0;
    if (static_cast<double>(problem.points()) <= most)
        return problem;
    EqualizerFitProblem thin = problem;
    for (auto* list : {&thin.frequency, &thin.warped, &thin.fixed, &thin.level, &thin.given, &thin.weight})
        list->clear();
    const double first = problem.frequency[0];
    const double last = problem.frequency[problem.points() - 1];
    double frequency = 0.0, level = 0.0, weight = 0.0;
    double edge = 1.0;
    const auto close = [&]
    {
        if (weight > 0.0)
        {
            thin.addFrequency(std::exp(frequency / weight));
            thin.level.push_back(level / weight);
            thin.weight.push_back(weight);
        }
        frequency = level = weight = 0.0;
    };
    for (std::size_t i = 0; i < problem.points(); ++i)
    {
        const double position = most * std::log(problem.frequency[i] / first) / std::log(last / first);
        if (position >= edge)
        {
            close();
            edge = std::floor(position) + 1.0;
        }
        frequency += problem.weight[i] * std::log(problem.frequency[i]);
        level += problem.weight[i] * problem.level[i];
        weight += problem.weight[i];
    }
    close();
    double sum = 0.0;
    for (const double w : thin.weight)
        sum += w;
    for (double& w : thin.weight)
        w *= static_cast<double>(thin.points()) / sum;
    thin.given = thin.weight;
    thin.noise = detail::noiseOf(thin.level);
    detail::boundSections(thin);
    detail::addGuards(thin);
    return thin;
}

} // namespace pacini
