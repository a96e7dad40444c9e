#pragma once

// Simulated participants, and the results of a study with them.

#include "study/Session.h"

#include <pacini/foundation/Gaussian.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pacini::study
{

/// Parameters of simulated participants.
struct ObserverParams
{
    double effect = 1.0;      ///< difference of the last group from the others, in points of the scale
    double stimulusSd = 0.9;  ///< of the stimuli's true values, points
    double biasSd = 0.8;      ///< of the participants' leaning, points
    double noiseSd = 1.7;     ///< of one rating, points
    double threshold = -30.0; ///< of detection at its best frequency, dB re full drive
    double thresholdSd = 4.0; ///< between participants, dB
    double slope = 3.5;       ///< of the psychometric function
    double lapse = 0.02;
    double discrimination = 0.8; ///< share of right answers in fixed comparisons
    std::uint64_t seed = 1;
};

/// One simulated participant, always the same of a seed and a slot.
class Observer
{
public:
    Observer(const Study& study, const ObserverParams& params, std::size_t slot);

    [[nodiscard]] Answer answer(const Trial& trial, std::optional<double> level);

    /// Strength (dB) of this participant's threshold for an adaptive stimulus.
    [[nodiscard]] double thresholdFor(const Block& block, std::size_t stimulus) const;

private:
    [[nodiscard]] double rated(const RatingScale& scale, double share);
    [[nodiscard]] double valueOfStimulus(std::size_t stimulus) const;

    Study study;
    ObserverParams params;
    Random random;
    double bias = 0.0;
    double ownThreshold = 0.0;
    bool isInLastGroup = false;
};

/// Runs one participant through a session that was begun. Errors: those of Session.
[[nodiscard]] Result<void> simulateSession(const Study& study, Session& session, const ObserverParams& params);

/// Power: how often studies find an existing effect.
struct PowerEstimate
{
    std::string first, second;  ///< groups that are compared
    double byParticipant = 0.0; ///< share of studies with p <= .05, one mean for each participant
    double standardError = 0.0; ///< of that share, from the number of runs
    double analytic = 0.0;      ///< the same by the non-central t distribution, for scales without ends and steps
    std::size_t runs = 0;
};

/// Returns the power of the comparison of the last group with each other one, over simulated studies; none for a single
/// group or without ratings.
[[nodiscard]] std::vector<PowerEstimate> estimatePower(const Study& study, const ObserverParams& params,
                                                       std::size_t runs);

/// Power of one comparison of a design for an effect.
struct EffectPower
{
    double effect = 0.0; ///< standardised: Cohen's d, of pairs the mean of the differences over their SD
    double points = 0.0; ///< the same on a scale of ten, by the SDs of ObserverParams and the design's trials
    double power = 0.0;  ///< two-sided at 5 %, without a correction for several comparisons
};

/// One comparison of a design, and how often it finds effects of these sizes.
struct DesignPower
{
    std::string first, second; ///< groups; empty for two stimuli, which the same people rate
    std::string block;         ///< of two stimuli
    int firstPeople = 0, secondPeople = 0;
    std::size_t trials = 0; ///< ratings of one person in the first group; of two stimuli, of each of them
    std::vector<EffectPower> effects;
};

/// Effects of a table of power, from small to very large (Cohen 1988).
inline constexpr std::array<double, 6> tabulatedEffects{0.2, 0.4, 0.6, 0.8, 1.0, 1.2};

/// Returns the power of a study by its people and trials, from the non-central t distribution: of each group against
/// the last one by a mean for each participant (pooled t-test), and in each block of ratings of two stimuli, over the
/// people who rate both (paired t-test). The effects are tabulatedEffects, or those of `points` on a scale of ten. None
/// without ratings of two people. Takes microseconds and has no random numbers.
[[nodiscard]] std::vector<DesignPower> powerOfDesign(const Study& study, const ObserverParams& params,
                                                     std::optional<double> points = std::nullopt);

} // namespace pacini::study
