#include "study/statistics/Correlation.h"

#include "study/statistics/Distributions.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace pacini::study
{

Correlation correlationOf(std::span<const double> first, std::span<const double> second)
{
    assert(first.size() == second.size());
    Correlation found;
    found.n = first.size();
    found.r95 = {-1.0, 1.0};
    const double meanX = meanOf(first), meanY = meanOf(second);
    const double squaresX = squaresOf(first), squaresY = squaresOf(second);
    double products = 0.0;
    for (std::size_t i = 0; i < first.size(); ++i)
        products += (first[i] - meanX) * (second[i] - meanY);
    if (!(squaresX > 0.0))
        return found;
    found.slope = products / squaresX;
    if (!(squaresY > 0.0))
        return found;
    found.r = std::clamp(products / std::sqrt(squaresX * squaresY), -1.0, 1.0);
    const auto n = static_cast<double>(found.n);
    if (found.n >= 3)
        found.p = std::abs(found.r) < 1.0
                      ? twoTailedT(found.r * std::sqrt((n - 2.0) / (1.0 - found.r * found.r)), n - 2.0)
                      : 0.0;
    if (found.n >= 4)
    {
        const double z = std::atanh(found.r), reach = normalQuantile(0.975) / std::sqrt(n - 3.0);
        found.r95 = {std::tanh(z - reach), std::tanh(z + reach)};
    }
    return found;
}

} // namespace pacini::study
