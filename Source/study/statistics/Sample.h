#pragma once

// Descriptive statistics of one sample.

#include <cstddef>
#include <span>
#include <vector>

namespace pacini::study
{

/// Confidence interval: contains the true value in the given share of all studies.
struct Interval
{
    double low = 0.0;
    double high = 0.0;
};

/// A sample in the numbers of a box plot and of a table.
struct SampleSummary
{
    std::size_t count = 0;
    double mean = 0.0;
    double sd = 0.0; ///< of the population, estimated: divided by count - 1; 0 of fewer than two
    Interval mean95; ///< of Student's t; the mean itself of fewer than two
    double lowest = 0.0;
    double lowerQuartile = 0.0; ///< linear between the order statistics (Hyndman and Fan 1996, type 7)
    double median = 0.0;
    double upperQuartile = 0.0;
    double highest = 0.0;
    Interval whiskers;            ///< the last values within 1.5 quartile distances of the box (Tukey 1977)
    std::vector<double> outliers; ///< the values beyond them, rising
};

/// All zero for no values. Values are finite.
[[nodiscard]] SampleSummary summaryOf(std::span<const double> values);

[[nodiscard]] double meanOf(std::span<const double> values) noexcept;

/// Sum of squared distances from the mean, in two passes, which avoids the cancellation of subtracted squares.
[[nodiscard]] double squaresOf(std::span<const double> values) noexcept;

/// Divided by count - 1; 0 of fewer than two.
[[nodiscard]] double sdOf(std::span<const double> values) noexcept;

/// Quantile of ascending values, `share` from 0 to 1.
[[nodiscard]] double quantileOfSorted(std::span<const double> sorted, double share) noexcept;

/// Ranks from 1 in the order of `values`; equal values share the mean of their ranks.
[[nodiscard]] std::vector<double> ranksOf(std::span<const double> values);

/// Sum of t^3 - t over all groups of t equal values, the tie correction of rank tests.
[[nodiscard]] double tieSumOf(std::span<const double> values);

} // namespace pacini::study
