#include "study/statistics/Proportion.h"

#include "study/statistics/Distributions.h"

#include <algorithm>
#include <cmath>

namespace pacini::study
{

Proportion proportionOf(std::span<const CountedAnswers> people)
{
    Proportion found;
    double m = 0.0;
    for (const CountedAnswers& one : people)
    {
        found.right += one.right;
        found.all += one.all;
        m += one.all > 0 ? 1.0 : 0.0;
    }
    if (found.all == 0)
        return found;
    const auto n = static_cast<double>(found.all);
    const double p = found.share = static_cast<double>(found.right) / n;
    double spread = 0.0;
    for (const CountedAnswers& one : people)
        spread += std::pow(static_cast<double>(one.right) - p * static_cast<double>(one.all), 2.0);
    const double ofChance = p * (1.0 - p) / n;
    const double designEffect = m > 1.0 && ofChance > 0.0 ? m / (m - 1.0) * spread / (n * n) / ofChance : 1.0;
    const double effective = n / std::max(1.0, designEffect);
    const double q = m > 1.0 ? quantileT(0.975, m - 1.0) : normalQuantile(0.975);
    const double whole = 1.0 + q * q / effective, middle = (p + q * q / (2.0 * effective)) / whole;
    const double half = q / whole * std::sqrt(p * (1.0 - p) / effective + q * q / (4.0 * effective * effective));
    found.share95 = {std::max(0.0, middle - half), std::min(1.0, middle + half)};
    return found;
}

} // namespace pacini::study
