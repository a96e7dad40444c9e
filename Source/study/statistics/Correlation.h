#pragma once

// Linear relation of two measures of the same people.

#include "study/statistics/Sample.h"

#include <cstddef>
#include <span>

namespace pacini::study
{

struct Correlation
{
    std::size_t n = 0;
    double r = 0.0;     ///< Pearson's; 0 without variance in either
    double slope = 0.0; ///< of the line of least squares, second on first; 0 without variance in the first
    double p = 1.0;     ///< two-sided, by Student's t; 1 of fewer than three
    Interval r95;       ///< by Fisher's (1921) transformation; -1 to 1 of fewer than four
};

/// As many values in both.
[[nodiscard]] Correlation correlationOf(std::span<const double> first, std::span<const double> second);

} // namespace pacini::study
