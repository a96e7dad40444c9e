#pragma once

// Results of a study: the answers of all sessions in its folder, by kind.

#include "study/Ratings.h"
#include "study/SessionLog.h"
#include "study/Study.h"
#include "study/Words.h"
#include "study/procedures/Staircase.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace pacini::study
{

/// A threshold of one participant.
struct PersonalThreshold
{
    std::string group, participant, block, stimulus;
    ThresholdEstimate estimate;
    double value = 0.0; ///< in the unit of the variable
    std::size_t trials = 0;
};

/// One answer of a staircase.
struct StaircaseAnswer
{
    std::string block, stimulus;
    double strength = 0.0; ///< dB
    bool right = false;
};

/// Right answers of one participant in a block of choices.
struct PersonalChoices
{
    std::string group, participant, block, stimulus;
    std::size_t right = 0, trials = 0;
};

/// Judgements of how unlike pairs are, of one participant.
struct PairRating
{
    std::string group, participant, block, first, second;
    double value = 0.0;
};

struct StudyResults
{
    Study study;
    std::vector<LoggedSession> sessions;
    std::vector<std::string> warnings; ///< logs that could not be read, unfinished sessions
    std::vector<Rating> ratings;       ///< of rating and multiStimulus
    std::vector<Rating> ranks;         ///< of ranking: 1 is the first place
    std::vector<Description> descriptions;
    std::vector<PersonalThreshold> thresholds;
    std::vector<StaircaseAnswer> staircaseAnswers; ///< of all participants
    std::vector<PersonalChoices> choices;
    std::vector<PairRating> pairs;    ///< of similarity
    std::vector<PairRating> together; ///< of sorting: 0 in one heap, 1 in two
    std::size_t dropouts = 0;         ///< trials that were repeated
};

/// The name of a study's file in its folder.
inline constexpr const char* studyFileName = "study.json";

/// Returns the file of a study, given by its folder or its file.
[[nodiscard]] std::filesystem::path studyFileOf(const std::filesystem::path& named);

/// Reads a study, given by its folder or file, and its sessions. Training and trials with drop-outs do not count.
/// Errors: those of readStudy(); io if there is no session.
[[nodiscard]] Result<StudyResults> readResults(const std::filesystem::path& named);

/// The study with the paths of its files from another folder.
[[nodiscard]] Study relocated(Study study, const std::filesystem::path& from, const std::filesystem::path& to);

/// The threshold of the answers of one staircase, in their order.
[[nodiscard]] std::optional<ThresholdEstimate> thresholdOf(const Block& block, const std::vector<Record>& records);

} // namespace pacini::study
