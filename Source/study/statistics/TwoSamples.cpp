#include "study/statistics/TwoSamples.h"

#include "study/statistics/Distributions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace pacini::study
{

namespace
{
double varianceOf(std::span<const double> values)
{
    const double sd = sdOf(values);
    return sd * sd;
}

/// t, p and interval of a difference with a standard error.
void judge(TTest& test, double error)
{
    test.difference95 = {test.difference, test.difference};
    if (!(error > 0.0))
    {
        if (test.difference != 0.0)
            test.t = std::copysign(std::numeric_limits<double>::infinity(), test.difference);
        test.p = test.difference != 0.0 ? 0.0 : 1.0;
        return;
    }
    test.t = test.difference / error;
    test.p = twoTailedT(test.t, test.degrees);
    const double half = quantileT(0.975, test.degrees) * error;
    test.difference95 = {test.difference - half, test.difference + half};
}

/// Share of all arrangements of n1 and n2 different values in which U is at most `u`: counts by the recursion of Mann
/// and Whitney, in double, exact to 2^53.
double exactLowerTail(std::size_t n1, std::size_t n2, double u)
{
    // ways[j][k]: arrangements of the values so far of which j are of the first sample, with U = k.
    const std::size_t most = n1 * n2;
    std::vector<std::vector<double>> ways(n1 + 1, std::vector<double>(most + 1, 0.0));
    ways[0][0] = 1.0;
    // A value of the first sample at rank i, with i - j of the second below it, adds that many to U.
    for (std::size_t i = 0; i < n1 + n2; ++i)
        for (std::size_t j = std::min(i + 1, n1); j > 0; --j)
        {
            const std::size_t below = i - (j - 1);
            if (below > n2)
                continue;
            for (std::size_t k = most + 1; k-- > below;)
                ways[j][k] += ways[j - 1][k - below];
        }
    const double all = std::accumulate(ways[n1].begin(), ways[n1].end(), 0.0);
    const auto end = std::min(static_cast<std::size_t>(u) + 1, most + 1);
    return std::accumulate(ways[n1].begin(), ways[n1].begin() + static_cast<std::ptrdiff_t>(end), 0.0) / all;
}

/// Share of all choices of signs in which the ranks of one sign add up to `w` at most. Ranks are whole or halves.
double signedLowerTail(const std::vector<double>& ranks, double w)
{
    const auto halves = [](double rank)
    {
        return static_cast<std::size_t>(std::lround(2.0 * rank));
    };
    std::vector<double> ways(halves(w) + 1, 0.0); // by twice the sum; in double, exact to 2^53
    ways[0] = 1.0;
    for (const double rank : ranks)
        for (std::size_t step = halves(rank), k = ways.size(); k-- > step;)
            ways[k] += ways[k - step];
    return std::ldexp(std::accumulate(ways.begin(), ways.end(), 0.0), -static_cast<int>(ranks.size()));
}
} // namespace

TTest pooledTTest(std::span<const double> first, std::span<const double> second)
{
    TTest test;
    const auto n1 = static_cast<double>(first.size()), n2 = static_cast<double>(second.size());
    test.difference = meanOf(first) - meanOf(second);
    test.degrees = n1 + n2 - 2.0;
    test.sd = std::sqrt((squaresOf(first) + squaresOf(second)) / test.degrees);
    judge(test, test.sd * std::sqrt(1.0 / n1 + 1.0 / n2));
    return test;
}

TTest welchTTest(std::span<const double> first, std::span<const double> second)
{
    TTest test;
    const auto n1 = static_cast<double>(first.size()), n2 = static_cast<double>(second.size());
    const double v1 = varianceOf(first) / n1, v2 = varianceOf(second) / n2;
    test.difference = meanOf(first) - meanOf(second);
    test.sd = std::sqrt(0.5 * (varianceOf(first) + varianceOf(second)));
    const double sum = v1 + v2;
    test.degrees = sum > 0.0 ? sum * sum / (v1 * v1 / (n1 - 1.0) + v2 * v2 / (n2 - 1.0)) : n1 + n2 - 2.0;
    judge(test, std::sqrt(sum));
    return test;
}

TTest pairedTTest(std::span<const double> first, std::span<const double> second)
{
    std::vector<double> differences;
    for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i)
        differences.push_back(first[i] - second[i]);
    TTest test;
    const auto n = static_cast<double>(differences.size());
    test.difference = meanOf(differences);
    test.degrees = n - 1.0;
    test.sd = sdOf(differences);
    judge(test, test.sd / std::sqrt(n));
    return test;
}

double equalVarianceP(std::span<const double> first, std::span<const double> second)
{
    const double v1 = varianceOf(first), v2 = varianceOf(second);
    if (!(v1 > 0.0) || !(v2 > 0.0))
        return v1 == v2 ? 1.0 : 0.0;
    const auto d1 = static_cast<double>(first.size() - 1), d2 = static_cast<double>(second.size() - 1);
    const double f = v1 / v2;
    return std::min(1.0, 2.0 * std::min(lowerTailF(f, d1, d2), upperTailF(f, d1, d2)));
}

MannWhitney mannWhitney(std::span<const double> first, std::span<const double> second)
{
    MannWhitney test;
    if (first.empty() || second.empty())
        return test;
    std::vector<double> all(first.begin(), first.end());
    all.insert(all.end(), second.begin(), second.end());
    const std::vector<double> ranks = ranksOf(all);
    const auto n1 = static_cast<double>(first.size()), n2 = static_cast<double>(second.size());
    const double rankSum =
        std::accumulate(ranks.begin(), ranks.begin() + static_cast<std::ptrdiff_t>(first.size()), 0.0);
    test.u = rankSum - 0.5 * n1 * (n1 + 1.0);
    const double ties = tieSumOf(all);
    const double smaller = std::min(test.u, n1 * n2 - test.u);
    constexpr std::size_t exactUpTo = 20;
    test.exact = ties == 0.0 && std::max(first.size(), second.size()) <= exactUpTo;
    if (test.exact)
    {
        test.p = std::min(1.0, 2.0 * exactLowerTail(first.size(), second.size(), smaller));
        return test;
    }
    const double n = n1 + n2;
    const double variance = n1 * n2 / 12.0 * (n + 1.0 - ties / (n * (n - 1.0)));
    // Half a step less than the distance from the middle: U moves in steps, the normal distribution does not.
    const double distance = 0.5 * n1 * n2 - smaller - 0.5;
    test.p = variance > 0.0 ? std::min(1.0, twoTailedNormal(std::max(distance, 0.0) / std::sqrt(variance))) : 1.0;
    return test;
}

SignedRanks signedRanks(std::span<const double> first, std::span<const double> second)
{
    std::vector<double> distances;
    std::vector<bool> rises;
    for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i)
        if (first[i] != second[i])
        {
            distances.push_back(std::abs(first[i] - second[i]));
            rises.push_back(first[i] > second[i]);
        }
    SignedRanks test;
    test.n = distances.size();
    const std::vector<double> ranks = ranksOf(distances);
    for (std::size_t i = 0; i < ranks.size(); ++i)
        test.w += rises[i] ? ranks[i] : 0.0;
    const auto n = static_cast<double>(test.n);
    const double sum = 0.5 * n * (n + 1.0), smaller = std::min(test.w, sum - test.w);
    constexpr std::size_t exactUpTo = 50;
    test.exact = test.n <= exactUpTo;
    if (test.exact)
    {
        test.p = std::min(1.0, 2.0 * signedLowerTail(ranks, smaller));
        return test;
    }
    const double variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - tieSumOf(distances) / 48.0;
    test.p = twoTailedNormal((0.5 * sum - smaller) / std::sqrt(variance));
    return test;
}

double hedgesG(std::span<const double> first, std::span<const double> second)
{
    const TTest test = pooledTTest(first, second);
    if (!(test.sd > 0.0))
        return 0.0;
    return test.difference / test.sd * (1.0 - 3.0 / (4.0 * test.degrees - 1.0));
}

std::vector<double> holm(std::span<const double> p)
{
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
    std::vector<double> corrected(p.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < order.size(); ++i)
    {
        largest = std::max(largest, std::min(1.0, p[order[i]] * static_cast<double>(p.size() - i)));
        corrected[order[i]] = largest;
    }
    return corrected;
}

std::vector<double> bonferroni(std::span<const double> p)
{
    std::vector<double> corrected;
    for (const double one : p)
        corrected.push_back(std::min(1.0, one * static_cast<double>(p.size())));
    return corrected;
}

} // namespace pacini::study
