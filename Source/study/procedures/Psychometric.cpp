#include "study/procedures/Psychometric.h"

#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pacini::study
{

double Psychometric::operator()(double strength) const noexcept
{
    const double missed = std::exp(-Decibels(slope * (strength - threshold)).gain());
    return 1.0 - lapse - (1.0 - guess - lapse) * missed;
}

PsychometricPosterior::PsychometricPosterior(const PsychometricPrior& prior)
    : grid(prior), weights(prior.thresholds.count * prior.slopes.count * prior.lapses.count)
{
    std::fill(weights.begin(), weights.end(), 1.0 / static_cast<double>(weights.size()));
}

Psychometric PsychometricPosterior::at(std::size_t i) const
{
    const std::size_t lapse = i % grid.lapses.count, slope = i / grid.lapses.count % grid.slopes.count;
    const std::size_t threshold = i / (grid.lapses.count * grid.slopes.count);
    return {grid.thresholds[threshold], grid.slopes[slope], grid.guess, grid.lapses[lapse]};
}

PsychometricPosterior::Candidate PsychometricPosterior::candidateAt(double strength) const
{
    const auto timesLog = [](double p)
    {
        return p > 0.0 ? p * std::log(p) : 0.0;
    };
    Candidate candidate;
    candidate.strength = strength;
    candidate.chances.reserve(weights.size());
    candidate.negentropies.reserve(weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
        const double p = at(i)(strength);
        candidate.chances.push_back(p);
        candidate.negentropies.push_back(timesLog(p) + timesLog(1.0 - p));
    }
    return candidate;
}

void PsychometricPosterior::update(double strength, bool right)
{
    update(candidateAt(strength), right);
}

void PsychometricPosterior::update(const Candidate& candidate, bool right)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
        weights[i] *= right ? candidate.chances[i] : 1.0 - candidate.chances[i];
        sum += weights[i];
    }
    // Nothing thinkable explains a wrong answer far above all thresholds without lapses: then it says nothing.
    for (double& weight : weights)
        weight = sum > 0.0 ? weight / sum : 1.0 / static_cast<double>(weights.size());
}

double PsychometricPosterior::expectedEntropy(const Candidate& candidate) const
{
    // With w the weights, p the chances and P = sum w p, the entropy after a right answer is -sum (wp/P) log (wp/P).
    // Times P, and the same for a wrong one, log P comes out of the sums, and log w, which is the same for every
    // candidate and left out: -sum w (p log p + q log q) + P log P + Q log Q.
    double right = 0.0, known = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
        right += weights[i] * candidate.chances[i];
        known += weights[i] * candidate.negentropies[i];
    }
    const double wrong = 1.0 - right;
    return -known + (right > 0.0 ? right * std::log(right) : 0.0) + (wrong > 0.0 ? wrong * std::log(wrong) : 0.0);
}

Psychometric PsychometricPosterior::mean() const
{
    Psychometric mean{0.0, 0.0, grid.guess, 0.0};
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
        const Psychometric one = at(i);
        mean.threshold += weights[i] * one.threshold;
        mean.slope += weights[i] * one.slope;
        mean.lapse += weights[i] * one.lapse;
    }
    return mean;
}

std::vector<double> PsychometricPosterior::thresholdWeights() const
{
    std::vector<double> sums(grid.thresholds.count, 0.0);
    const std::size_t each = grid.lapses.count * grid.slopes.count;
    for (std::size_t i = 0; i < weights.size(); ++i)
        sums[i / each] += weights[i];
    return sums;
}

double PsychometricPosterior::thresholdSd() const
{
    const double middle = mean().threshold;
    const std::vector<double> sums = thresholdWeights();
    double variance = 0.0;
    for (std::size_t i = 0; i < sums.size(); ++i)
        variance += sums[i] * (grid.thresholds[i] - middle) * (grid.thresholds[i] - middle);
    return std::sqrt(variance);
}

Interval PsychometricPosterior::threshold95() const
{
    const std::vector<double> sums = thresholdWeights();
    const auto where = [&](double share)
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < sums.size(); ++i)
            if ((sum += sums[i]) >= share)
                return grid.thresholds[i];
        return grid.thresholds[sums.size() - 1];
    };
    return {where(0.025), where(0.975)};
}

Interval PsychometricPosterior::share95(double strength) const
{
    std::vector<std::pair<double, double>> shares; // with their weights
    shares.reserve(weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i)
        shares.emplace_back(at(i)(strength), weights[i]);
    std::sort(shares.begin(), shares.end());
    Interval found{shares.front().first, shares.back().first};
    double sum = 0.0;
    bool low = false;
    for (const auto& [share, weight] : shares)
    {
        sum += weight;
        if (!low && sum >= 0.025)
        {
            found.low = share;
            low = true;
        }
        if (sum >= 0.975)
        {
            found.high = share;
            break;
        }
    }
    return found;
}

} // namespace pacini::study
