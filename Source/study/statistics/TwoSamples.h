#pragma once

// Comparison of two samples: t-tests, F-test, Mann-Whitney, effect sizes; correction for many of them.

#include "study/statistics/Sample.h"

#include <cstddef>
#include <span>
#include <vector>

namespace pacini::study
{

/// Outcome of a t-test. Without variance t is 0 or infinite.
struct TTest
{
    double difference = 0.0; ///< of the means, first minus second
    double t = 0.0;
    double degrees = 0.0;
    double sd = 0.0; ///< pooled, or of the differences of a paired test; of Welch's the root of the mean variance
    double p = 1.0;  ///< two-sided
    Interval difference95;
};

/// Student's t-test of independent samples with a common variance (Student 1908). Two values in each at least.
[[nodiscard]] TTest pooledTTest(std::span<const double> first, std::span<const double> second);

/// Welch's t-test (1947), for variances that may differ, with Satterthwaite's degrees of freedom.
[[nodiscard]] TTest welchTTest(std::span<const double> first, std::span<const double> second);

/// Paired t-test; as many values in both.
[[nodiscard]] TTest pairedTTest(std::span<const double> first, std::span<const double> second);

/// Two-sided p of the F-test of equal variances.
[[nodiscard]] double equalVarianceP(std::span<const double> first, std::span<const double> second);

struct MannWhitney
{
    double u = 0.0; ///< of the first sample: pairs in which it is larger, equal ones half
    double p = 1.0; ///< two-sided
    bool exact = false;
};

/// Mann and Whitney (1947). Exact without ties and up to 20 values in each, else by the normal distribution with
/// corrections for continuity and ties.
[[nodiscard]] MannWhitney mannWhitney(std::span<const double> first, std::span<const double> second);

struct SignedRanks
{
    double w = 0.0;    ///< sum of the ranks of positive differences
    std::size_t n = 0; ///< pairs that differ
    double p = 1.0;    ///< two-sided
    bool exact = false;
};

/// Wilcoxon's (1945) signed-rank test of pairs, as many values in both; equal pairs are left out. Exact up to 50 pairs,
/// also with ties, else by the normal distribution with a correction for ties.
[[nodiscard]] SignedRanks signedRanks(std::span<const double> first, std::span<const double> second);

/// Difference of the means in pooled SDs (Cohen's d), times Hedges' (1981) correction for small samples; 0 without
/// variance.
[[nodiscard]] double hedgesG(std::span<const double> first, std::span<const double> second);

/// p after Holm (1979), in the given order: step down, never above 1.
[[nodiscard]] std::vector<double> holm(std::span<const double> p);

/// p times their number, never above 1.
[[nodiscard]] std::vector<double> bonferroni(std::span<const double> p);

} // namespace pacini::study
