#pragma once

// Psychometric function, and estimation of its parameters from answers.

#include "study/statistics/Sample.h"

#include <cstddef>
#include <vector>

namespace pacini::study
{

/// Share of right answers at a strength (Weibull over dB, as in Watson 2017, eq. 3).
struct Psychometric
{
    double threshold = 0.0; ///< dB; there the share of what is not guessed or lapsed is 1 - 1/e
    double slope = 3.5;
    double guess = 0.5; ///< right without feeling anything: 1 / intervals
    double lapse = 0.02;

    [[nodiscard]] double operator()(double strength) const noexcept;
};

/// Evenly spaced values.
struct Grid
{
    double low = 0.0;
    double high = 0.0;
    std::size_t count = 1;

    [[nodiscard]] double operator[](std::size_t i) const noexcept
    {
        return count < 2 ? low : low + (high - low) * static_cast<double>(i) / static_cast<double>(count - 1);
    }
};

/// Prior range of thresholds, slopes and lapses, all equally probable before the first answer.
struct PsychometricPrior
{
    Grid thresholds;
    Grid slopes{2.0, 7.0, 6}; ///< thresholds of touch rise steeply; flatter ones pull the mean down
    Grid lapses{0.0, 0.04, 3};
    double guess = 0.5;
};

/// Probability of the parameters after the answers so far, on the grid of the prior.
class PsychometricPosterior
{
public:
    explicit PsychometricPosterior(const PsychometricPrior& prior);

    /// After an answer at `strength`.
    void update(double strength, bool right);

    /// Precomputed value of an answer at a strength.
    struct Candidate
    {
        double strength = 0.0;
        std::vector<double> chances;      ///< of a right answer, for each of the parameters
        std::vector<double> negentropies; ///< p log p + (1 - p) log (1 - p) of these
    };
    [[nodiscard]] Candidate candidateAt(double strength) const;

    /// As the other one, for a strength that is known.
    void update(const Candidate& candidate, bool right);

    /// Expected entropy after one more answer at the strength, in nats, without terms that all candidates share.
    [[nodiscard]] double expectedEntropy(const Candidate& candidate) const;

    /// The mean of each parameter.
    [[nodiscard]] Psychometric mean() const;

    /// Standard deviation of the threshold.
    [[nodiscard]] double thresholdSd() const;
    [[nodiscard]] Interval threshold95() const;

    /// 95 % interval of the share of right answers at a strength.
    [[nodiscard]] Interval share95(double strength) const;

private:
    [[nodiscard]] Psychometric at(std::size_t i) const;
    [[nodiscard]] std::vector<double> thresholdWeights() const;

    PsychometricPrior grid;
    std::vector<double> weights; ///< threshold after threshold, in each slope after slope
};

} // namespace pacini::study
