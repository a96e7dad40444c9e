#pragma once

// Adaptive procedures: which strength comes next, and which threshold the answers show.

#include "study/Study.h"
#include "study/procedures/Psychometric.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace pacini::study
{

/// Result of a procedure.
struct ThresholdEstimate
{
    double strength = 0.0; ///< dB
    double sd = 0.0;       ///< dB
    Interval strength95;
    double share = 0.0; ///< of right answers at the threshold
};

/// Transformed up-down (H. Levitt, "Transformed up-down methods in psychoacoustics", JASA 49, 1971): harder after so
/// many right answers in a row, easier after each wrong one; the mean of the reversals is where half of the rows are
/// right, at the share .5^(1/down).
class LevittStaircase
{
public:
    /// `adaptive` as validate() takes it.
    explicit LevittStaircase(const Adaptive& adaptive);

    [[nodiscard]] double strength() const noexcept { return current; }
    void answer(bool right);
    [[nodiscard]] bool isDone() const noexcept;

    /// The mean of all reversals but the first two (but the first, if there are too few); none before any.
    [[nodiscard]] std::optional<ThresholdEstimate> threshold() const;

    [[nodiscard]] int trials() const noexcept { return answered; }

private:
    Adaptive params;
    double lowest, highest; ///< dB of strength
    double current;
    int rightInRow = 0;
    int direction = 0; ///< of the last move: 1 up, -1 down
    int answered = 0;
    std::vector<double> reversals;
};

/// QUEST+ (A. B. Watson, "QUEST+: A general multidimensional Bayesian adaptive psychometric method", Journal of Vision
/// 17(3):10, 2017): the next strength is that after whose answer the least entropy is to be expected.
class QuestPlus
{
public:
    /// `intervals` is the number of intervals to choose from; `adaptive` must pass validate().
    QuestPlus(const Adaptive& adaptive, int intervals);

    [[nodiscard]] double strength() const noexcept { return candidates[next].strength; }
    void answer(bool right);
    [[nodiscard]] bool isDone() const noexcept { return answered >= most; }
    [[nodiscard]] ThresholdEstimate threshold() const;
    [[nodiscard]] int trials() const noexcept { return answered; }
    [[nodiscard]] const PsychometricPosterior& posterior() const noexcept { return beliefs; }

private:
    void choose();

    PsychometricPosterior beliefs;
    std::vector<PsychometricPosterior::Candidate> candidates;
    int most;
    int answered = 0;
    std::size_t next = 0; ///< of the candidates
};

/// The thresholds and strengths that QUEST+ thinks of: a grid of 1 dB or finer from the easiest to the hardest.
[[nodiscard]] Grid strengthGrid(const Adaptive& adaptive);

/// The prior of thresholds in that range, for the number of intervals.
[[nodiscard]] PsychometricPrior priorOf(const Adaptive& adaptive, int intervals);

/// Either of them.
class Staircase
{
public:
    Staircase(const Adaptive& adaptive, int intervals);

    [[nodiscard]] double strength() const noexcept;
    void answer(bool right);
    [[nodiscard]] bool isDone() const noexcept;
    [[nodiscard]] std::optional<ThresholdEstimate> threshold() const;
    [[nodiscard]] int trials() const noexcept;

private:
    std::optional<LevittStaircase> levitt;
    std::optional<QuestPlus> quest;
};

} // namespace pacini::study
