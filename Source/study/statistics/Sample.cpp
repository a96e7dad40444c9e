#include "study/statistics/Sample.h"

#include "study/statistics/Distributions.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pacini::study
{

double meanOf(std::span<const double> values) noexcept
{
    if (values.empty())
        return 0.0;
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double squaresOf(std::span<const double> values) noexcept
{
    const double mean = meanOf(values);
    double sum = 0.0;
    for (const double value : values)
        sum += (value - mean) * (value - mean);
    return sum;
}

double sdOf(std::span<const double> values) noexcept
{
    return values.size() < 2 ? 0.0 : std::sqrt(squaresOf(values) / static_cast<double>(values.size() - 1));
}

double quantileOfSorted(std::span<const double> sorted, double share) noexcept
{
    if (sorted.empty())
        return 0.0;
    const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

SampleSummary summaryOf(std::span<const double> values)
{
    SampleSummary summary;
    if (values.empty())
        return summary;
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    summary.count = sorted.size();
    summary.mean = meanOf(sorted);
    summary.sd = sdOf(sorted);
    summary.mean95 = {summary.mean, summary.mean};
    if (sorted.size() > 1)
    {
        const auto n = static_cast<double>(sorted.size());
        const double half = quantileT(0.975, n - 1.0) * summary.sd / std::sqrt(n);
        summary.mean95 = {summary.mean - half, summary.mean + half};
    }
    summary.lowest = sorted.front();
    summary.lowerQuartile = quantileOfSorted(sorted, 0.25);
    summary.median = quantileOfSorted(sorted, 0.5);
    summary.upperQuartile = quantileOfSorted(sorted, 0.75);
    summary.highest = sorted.back();
    const double reach = 1.5 * (summary.upperQuartile - summary.lowerQuartile);
    summary.whiskers = {summary.lowerQuartile, summary.upperQuartile};
    for (const double value : sorted)
    {
        if (value < summary.lowerQuartile - reach || value > summary.upperQuartile + reach)
            summary.outliers.push_back(value);
        else
            summary.whiskers = {std::min(summary.whiskers.low, value), std::max(summary.whiskers.high, value)};
    }
    return summary;
}

std::vector<double> ranksOf(std::span<const double> values)
{
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> ranks(values.size());
    for (std::size_t first = 0; first < order.size();)
    {
        std::size_t end = first + 1;
        while (end < order.size() && values[order[end]] == values[order[first]])
            ++end;
        const double shared = 0.5 * static_cast<double>(first + 1 + end);
        for (std::size_t i = first; i < end; ++i)
            ranks[order[i]] = shared;
        first = end;
    }
    return ranks;
}

double tieSumOf(std::span<const double> values)
{
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    double sum = 0.0;
    for (std::size_t first = 0; first < sorted.size();)
    {
        std::size_t end = first + 1;
        while (end < sorted.size() && sorted[end] == sorted[first])
            ++end;
        const auto t = static_cast<double>(end - first);
        sum += t * t * t - t;
        first = end;
    }
    return sum;
}

} // namespace pacini::study
