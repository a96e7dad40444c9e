#pragma once

// Tail probabilities and quantiles of the distributions that tests refer to (Boost.Math).

namespace pacini::study
{

/// P(|T| >= |t|) of Student's t with `degrees` (above 0, may have a fraction) degrees of freedom; 1 for NaN.
[[nodiscard]] double twoTailedT(double t, double degrees);

/// P(F >= f) of the F distribution.
[[nodiscard]] double upperTailF(double f, double numeratorDegrees, double denominatorDegrees);

/// P(F <= f).
[[nodiscard]] double lowerTailF(double f, double numeratorDegrees, double denominatorDegrees);

/// P(X >= x) of chi-squared.
[[nodiscard]] double upperTailChiSquared(double x, double degrees);

/// P(|Z| >= |z|) of the standard normal distribution.
[[nodiscard]] double twoTailedNormal(double z);

/// Quantile of the standard normal distribution at `p`, 0 < p < 1.
[[nodiscard]] double normalQuantile(double p);

/// The t below which the share `p` lies, 0 < p < 1.
[[nodiscard]] double quantileT(double p, double degrees);

/// The f below which the share `p` lies.
[[nodiscard]] double quantileF(double p, double numeratorDegrees, double denominatorDegrees);

/// P(|T| >= critical) where T is non-central t: the power of a two-sided t-test.
[[nodiscard]] double powerOfT(double critical, double degrees, double noncentrality);

} // namespace pacini::study
