#pragma once

// Mixed models of ratings, fitted by Python's statsmodels.

#include "study/Ratings.h"

#include <pacini/foundation/Result.h>

#include <string>
#include <vector>

namespace pacini::cli
{

/// A fixed effect, with the test of whether it is 0 (Wald).
struct FixedEffect
{
    std::string name;
    double estimate = 0.0;
    double error = 0.0;           ///< standard error
    double low = 0.0, high = 0.0; ///< 95 %
    double p = 1.0;
};

/// Ratings by group and stimulus, over people and stimuli that are a sample of many.
struct MixedModel
{
    std::vector<FixedEffect> groups; ///< the first group's mean, and how the others differ; participants and stimuli
                                     ///< are random
    double participantVariance = 0.0, stimulusVariance = 0.0, residualVariance = 0.0; ///< of that model
    std::vector<FixedEffect> stimuli; ///< likewise of the stimuli; participants are random
    bool converged = false;
    std::string program; ///< "statsmodels 0.14.4"
};

/// By restricted maximum likelihood. Starts `python3` of the PATH. Errors: io where there is none, or none with
/// statsmodels; invalidData where the model cannot be fitted.
[[nodiscard]] Result<MixedModel> fitMixedModel(const std::vector<study::Rating>& ratings);

} // namespace pacini::cli
