#include "study/statistics/Agreement.h"

#include "study/statistics/Distributions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pacini::study
{

IntraclassCorrelation intraclassCorrelation(const RatingTable& table)
{
    IntraclassCorrelation found;
    if (table.size() < 2 || table.front().size() < 2)
        return found;
    // Targets are the stimuli, raters the participants.
    const std::size_t raters = table.size(), targets = table.front().size();
    const auto k = static_cast<double>(raters), n = static_cast<double>(targets);
    std::vector<double> ofRaters, ofTargets, all;
    for (const auto& row : table)
    {
        ofRaters.push_back(meanOf(row));
        all.insert(all.end(), row.begin(), row.end());
    }
    for (std::size_t i = 0; i < targets; ++i)
    {
        std::vector<double> column;
        for (const auto& row : table)
            column.push_back(row[i]);
        ofTargets.push_back(meanOf(column));
    }
    const double betweenTargets = k * squaresOf(ofTargets), betweenRaters = n * squaresOf(ofRaters);
    const double rest = std::max(0.0, squaresOf(all) - betweenTargets - betweenRaters);
    const double msr = betweenTargets / (n - 1.0), msc = betweenRaters / (k - 1.0);
    const double mse = rest / ((n - 1.0) * (k - 1.0));
    const double single = msr + (k - 1.0) * mse + k * (msc - mse) / n;
    const double mean = msr + (msc - mse) / n;
    if (!(single > 0.0) || !(mean > 0.0))
        return found;
    found.single = (msr - mse) / single;
    found.mean = (msr - mse) / mean;
    // McGraw and Wong (1996), table 7.
    const double a = k * found.single / (n * (1.0 - found.single));
    const double b = 1.0 + k * found.single * (n - 1.0) / (n * (1.0 - found.single));
    const double numerator = (a * msc + b * mse) * (a * msc + b * mse);
    const double denominator = (a * msc) * (a * msc) / (k - 1.0) + (b * mse) * (b * mse) / ((n - 1.0) * (k - 1.0));
    found.single95 = {found.single, found.single};
    if (denominator > 0.0)
    {
        const double v = numerator / denominator;
        const double lower = quantileF(0.975, n - 1.0, v), upper = quantileF(0.975, v, n - 1.0);
        const double spread = k * msc + (k * n - k - n) * mse;
        found.single95 = {n * (msr - lower * mse) / (lower * spread + n * msr),
                          n * (upper * msr - mse) / (spread + n * upper * msr)};
    }
    return found;
}

Friedman friedman(const RatingTable& table)
{
    Friedman found;
    if (table.size() < 2 || table.front().size() < 2)
        return found;
    const auto n = static_cast<double>(table.size()), k = static_cast<double>(table.front().size());
    std::vector<double> rankSums(table.front().size(), 0.0);
    double ties = 0.0;
    for (const auto& row : table)
    {
        const std::vector<double> ranks = ranksOf(row);
        for (std::size_t i = 0; i < ranks.size(); ++i)
            rankSums[i] += ranks[i];
        ties += tieSumOf(row);
    }
    const double spread = n * n * k * (k * k - 1.0) - n * ties;
    found.degrees = k - 1.0;
    if (!(spread > 0.0))
        return found;
    found.kendallsW = 12.0 * squaresOf(rankSums) / spread;
    found.chiSquared = n * (k - 1.0) * found.kendallsW;
    found.p = upperTailChiSquared(found.chiSquared, found.degrees);
    return found;
}

CohensKappa cohensKappa(const std::vector<std::pair<std::size_t, std::size_t>>& codes)
{
    CohensKappa found;
    if (codes.empty())
        return found;
    std::size_t categories = 0;
    for (const auto& [first, second] : codes)
        categories = std::max({categories, first + 1, second + 1});
    const double one = 1.0 / static_cast<double>(codes.size());
    std::vector<double> ofFirst(categories), ofSecond(categories);
    for (const auto& [first, second] : codes)
    {
        ofFirst[first] += one;
        ofSecond[second] += one;
        found.agreement += first == second ? one : 0.0;
    }
    double chance = 0.0;
    for (std::size_t i = 0; i < categories; ++i)
        chance += ofFirst[i] * ofSecond[i];
    if (!(chance < 1.0 - 1e-12))
        return found;
    found.kappa = (found.agreement - chance) / (1.0 - chance);
    double sum = 0.0;
    for (const auto& [first, second] : codes)
    {
        const double unlike = 1.0 - found.kappa;
        const double term = first == second ? 1.0 - (ofFirst[first] + ofSecond[first]) * unlike
                                            : (ofSecond[first] + ofFirst[second]) * unlike;
        sum += one * term * term;
    }
    const double offset = found.kappa - chance * (1.0 - found.kappa);
    const double error = std::sqrt(std::max(0.0, sum - offset * offset) * one) / (1.0 - chance);
    const double reach = normalQuantile(0.975) * error;
    found.kappa95 = {found.kappa - reach, std::min(1.0, found.kappa + reach)};
    return found;
}

} // namespace pacini::study
