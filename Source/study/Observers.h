#pragma once

// Simulated participants, and the results of a study with them.

#include "study/Session.h"

#include <pacini/foundation/Gaussian.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
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

} // namespace pacini::study
