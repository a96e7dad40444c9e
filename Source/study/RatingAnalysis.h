#pragma once

// Analysis of the ratings of one block: each stimulus in each group, tests between groups and between stimuli.

#include "study/Ratings.h"
#include "study/statistics/Agreement.h"
#include "study/statistics/TwoSamples.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pacini::study
{

/// A group's ratings of the stimuli.
struct GroupRatings
{
    std::string name;
    std::vector<std::string> participants;
    std::vector<std::vector<double>> byStimulus; ///< a list for each stimulus; participants in their order
    std::vector<double> all;
    std::vector<double> participantMeans;
    std::vector<double> stimulusMeans; ///< of the stimuli that the group has rated
    RatingTable complete;              ///< of the participants who have rated every stimulus
};

/// Tests of one group's ratings against another's, the first minus the second.
struct GroupComparison
{
    std::string first, second;
    bool combined = false; ///< one of them is a union, whose tests repeat what its groups have shown
    std::optional<TTest> byParticipant, byParticipantWelch; ///< of a mean for each participant: people are the sample
    std::optional<MannWhitney> byParticipantRanks;
    double effect = 0.0;             ///< Hedges' g of the participants' means
    double holm = 1.0;               ///< of byParticipant, over the comparisons that are shown
    std::optional<TTest> byStimulus; ///< of a mean for each stimulus: what holds for more stimuli of their kind
    double byStimulusEqualVarianceP = 1.0;
    struct OfStimulus
    {
        std::size_t stimulus = 0;
        TTest pooled, welch;
        MannWhitney ranks;
        double effect = 0.0;
        double holm = 1.0, bonferroni = 1.0; ///< over all stimuli of all comparisons
    };
    std::vector<OfStimulus> stimuli;
};

/// Two stimuli that the same people have rated.
struct StimulusComparison
{
    std::size_t first = 0, second = 0;
    TTest paired;
    double holm = 1.0;
};

struct RatingAnalysis
{
    std::vector<std::string> stimuli;
    std::vector<GroupRatings> groups; ///< of the study; unions after them
    std::size_t plainGroups = 0;
    GroupRatings everybody;
    std::vector<GroupComparison> comparisons;
    std::vector<StimulusComparison> pairs; ///< of stimuli, over everybody; none where more than 45
    IntraclassCorrelation agreement;       ///< of all participants who have rated everything
    Friedman order;
};

/// Groups that are put together, such as {"A", "B"}.
using GroupUnion = std::vector<std::string>;

/// Of ratings of one block. A participant who has rated a stimulus several times counts once, with the mean. `unions`
/// are compared with the groups that they do not hold.
[[nodiscard]] RatingAnalysis analyseRatings(const std::vector<Rating>& ratings,
                                            const std::vector<GroupUnion>& unions = {});

} // namespace pacini::study
