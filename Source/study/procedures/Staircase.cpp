#include "study/procedures/Staircase.h"

#include "study/statistics/Distributions.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace pacini::study
{

namespace
{
std::pair<double, double> rangeOf(const Adaptive& adaptive)
{
    const double a = strengthOf(adaptive.variable, adaptive.lowest),
                 b = strengthOf(adaptive.variable, adaptive.highest);
    return {std::min(a, b), std::max(a, b)};
}
} // namespace

LevittStaircase::LevittStaircase(const Adaptive& adaptive)
    : params(adaptive),
      lowest(rangeOf(adaptive).first),
      highest(rangeOf(adaptive).second),
      current(strengthOf(adaptive.variable, adaptive.start))
{
}

bool LevittStaircase::isDone() const noexcept
{
    return static_cast<int>(reversals.size()) >= params.reversals || answered >= params.trials;
}

void LevittStaircase::answer(bool right)
{
    ++answered;
    rightInRow = right ? rightInRow + 1 : 0;
    if (right && rightInRow < params.down)
        return;
    rightInRow = 0;
    const int move = right ? -1 : 1;
    if (direction != 0 && move != direction)
        reversals.push_back(current);
    direction = move;
    const double step = reversals.size() < 2 ? params.step : params.finalStep;
    current = std::clamp(current + move * step, lowest, highest);
}

std::optional<ThresholdEstimate> LevittStaircase::threshold() const
{
    constexpr std::size_t first = 2; // of reversals on the way there
    std::span<const double> counted(reversals);
    if (counted.size() > first + 1)
        counted = counted.subspan(first);
    if (counted.empty())
        return std::nullopt;
    // As many ups as downs, so that neither side of the threshold counts more.
    if (counted.size() > 2 && counted.size() % 2 == 1)
        counted = counted.subspan(1);
    ThresholdEstimate found;
    found.share = std::pow(0.5, 1.0 / params.down);
    const SampleSummary summary = summaryOf(counted);
    found.strength = summary.mean;
    found.sd = summary.sd;
    found.strength95 = summary.mean95;
    return found;
}

Grid strengthGrid(const Adaptive& adaptive)
{
    const auto [low, high] = rangeOf(adaptive);
    const auto steps = static_cast<std::size_t>(std::clamp(std::ceil(high - low), 20.0, 120.0));
    return {low, high, steps + 1};
}

PsychometricPrior priorOf(const Adaptive& adaptive, int intervals)
{
    PsychometricPrior prior;
    prior.thresholds = strengthGrid(adaptive);
    prior.guess = 1.0 / intervals;
    return prior;
}

QuestPlus::QuestPlus(const Adaptive& adaptive, int intervals)
    : beliefs(priorOf(adaptive, intervals)), most(adaptive.trials)
{
    const Grid strengths = strengthGrid(adaptive);
    for (std::size_t i = 0; i < strengths.count; ++i)
        candidates.push_back(beliefs.candidateAt(strengths[i]));
    choose();
}

void QuestPlus::choose()
{
    double least = 0.0;
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
        const double entropy = beliefs.expectedEntropy(candidates[i]);
        if (i == 0 || entropy < least)
        {
            least = entropy;
            next = i;
        }
    }
}

void QuestPlus::answer(bool right)
{
    beliefs.update(candidates[next], right);
    ++answered;
    if (!isDone())
        choose();
}

ThresholdEstimate QuestPlus::threshold() const
{
    const Psychometric mean = beliefs.mean();
    return {mean.threshold, beliefs.thresholdSd(), beliefs.threshold95(), mean(mean.threshold)};
}

Staircase::Staircase(const Adaptive& adaptive, int intervals)
{
    if (adaptive.procedure == Procedure::levitt)
        levitt.emplace(adaptive);
    else
        quest.emplace(adaptive, intervals);
}

double Staircase::strength() const noexcept
{
    return levitt ? levitt->strength() : quest->strength();
}

void Staircase::answer(bool right)
{
    if (levitt)
        levitt->answer(right);
    else
        quest->answer(right);
}

bool Staircase::isDone() const noexcept
{
    return levitt ? levitt->isDone() : quest->isDone();
}

std::optional<ThresholdEstimate> Staircase::threshold() const
{
    return levitt ? levitt->threshold() : std::optional(quest->threshold());
}

int Staircase::trials() const noexcept
{
    return levitt ? levitt->trials() : quest->trials();
}

} // namespace pacini::study
