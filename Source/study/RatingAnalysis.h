#pragma once

// Analysis of the ratings of one block: statistics of each stimulus in each group, tests between groups and between
// stimuli.

#include "study/Ratings.h"
#include "study/statistics/Agreement.h"
#include "study/statistics/TwoSamples.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pacini::study
{

/// A group's ratings of the stimuli, one for each participant and stimulus.
struct GroupRatings
{
    std::string name;
    std::vector<std::string> participants;
    std::vector<std::vector<double>> byStimulus; ///< a list for each stimulus; participants in their order
    std::vector<double> all;
    std::vector<double> participantMeans;                 ///< of the stimuli that each has rated
    std::vector<double> stimulusMeans;                    ///< of the stimuli that the group has rated
    std::vector<std::vector<std::optional<double>>> rows; ///< of each participant, with what is missing
    RatingTable complete;                                 ///< of the participants who have rated every stimulus
};

/// Tests of one group's ratings against another's, the first minus the second.
struct GroupComparison
{
    std::string first, second;
    bool combined = false; ///< one of them is a union, whose tests repeat those of its groups
    std::optional<TTest> byParticipant, byParticipantWelch; ///< by one mean for each participant
    std::optional<MannWhitney> byParticipantRanks;
    double effect = 0.0;             ///< Hedges' g of the participants' means
    double holm = 1.0;               ///< of byParticipant, over the comparisons that are shown
    std::optional<TTest> byStimulus; ///< by one mean for each stimulus: valid for more stimuli of their kind
    bool stimuliArePaired = false;   ///< byStimulus is of the differences: both groups have rated the same stimuli
    double byStimulusEqualVarianceP = 1.0; ///< where they are not paired
    struct OfStimulus
    {
        std::size_t stimulus = 0;
        TTest pooled, welch;
        MannWhitney ranks;
        double effect = 0.0;
        double holm = 1.0, bonferroni = 1.0; ///< of `pooled`, of places of `ranks`; over all stimuli of all comparisons
    };
    std::vector<OfStimulus> stimuli;
};

/// Comparison of two stimuli, over the people who rated both.
struct StimulusComparison
{
    std::size_t first = 0, second = 0;
    TTest paired;
    SignedRanks ranks;
    double holm = 1.0; ///< of `paired`, of places of `ranks`; over all pairs
};

/// Numbers on a scale, or places in an order. Places of one person have always the same mean, and are compared by their
/// ranks.
enum class AnswerKind
{
    ratings,
    places
};

/// A union of groups, such as {"A", "B"}.
using GroupUnion = std::vector<std::string>;

struct RatingAnalysisParams
{
    std::vector<GroupUnion> unions; ///< are compared with the groups that they do not hold
    AnswerKind kind = AnswerKind::ratings;
    bool pairStimuli = true; ///< false: means for each stimulus are independent samples, as Weber (2020) has them
};

/// Pairs of more stimuli are not compared.
inline constexpr std::size_t mostPairedStimuli = 500;

struct RatingAnalysis
{
    AnswerKind kind = AnswerKind::ratings;
    std::vector<std::string> stimuli;
    std::vector<GroupRatings> groups; ///< of the study; unions after them
    std::size_t plainGroups = 0;
    GroupRatings everybody;
    std::vector<GroupComparison> comparisons;
    std::vector<StimulusComparison> pairs; ///< of stimuli, over everybody; none of more than mostPairedStimuli
    IntraclassCorrelation agreement;       ///< of all participants who have rated everything
    Friedman order;
    std::vector<std::string> doubts; ///< sentences about missing data and participants who may be one person
};

/// Analyses the ratings of one block. A participant who rated a stimulus several times counts once, with the mean.
/// Participants belong to a group: the same name in two groups is two people, which `doubts` reports.
[[nodiscard]] RatingAnalysis analyseRatings(const std::vector<Rating>& ratings,
                                            const RatingAnalysisParams& params = {});

} // namespace pacini::study
