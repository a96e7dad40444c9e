#pragma once

// Agreement of raters, and differences between items that all of them rated: ICC, Kendall's W, Friedman, Cohen's kappa.

#include "study/statistics/Sample.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace pacini::study
{

/// Ratings of a group: a row for each participant, in it a value for each stimulus.
using RatingTable = std::vector<std::vector<double>>;

/// Intraclass correlations of two-way random effects, absolute agreement (Shrout and Fleiss 1979; McGraw and Wong
/// 1996).
struct IntraclassCorrelation
{
    double single = 0.0; ///< ICC(2,1), of one rater
    double mean = 0.0;   ///< ICC(2,k), of the mean of all
    Interval single95;
};

/// Two participants and two stimuli at least; all zero where nothing varies.
[[nodiscard]] IntraclassCorrelation intraclassCorrelation(const RatingTable& table);

struct Friedman
{
    double chiSquared = 0.0;
    double degrees = 0.0;
    double p = 1.0;
    double kendallsW = 0.0; ///< 0: no agreement about the order of stimuli, 1: all the same
};

/// Friedman's (1937) test with correction for ties, and Kendall and Babington Smith's (1939) W.
[[nodiscard]] Friedman friedman(const RatingTable& table);

/// Agreement of two coders who sorted the same things into categories.
struct CohensKappa
{
    double kappa = 0.0;     ///< 0: as by chance, 1: the same; 0 where both used one category alone
    Interval kappa95;       ///< of large samples
    double agreement = 0.0; ///< share of the same category, 0 to 1
};

/// Cohen's (1960) kappa with the standard error of Fleiss, Cohen and Everitt (1969). `codes` has a pair of categories,
/// from 0, for each thing; all zero where there is none.
[[nodiscard]] CohensKappa cohensKappa(const std::vector<std::pair<std::size_t, std::size_t>>& codes);

} // namespace pacini::study
