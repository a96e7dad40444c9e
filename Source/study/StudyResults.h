#pragma once

// Results of a study: the answers of all sessions in its folder, by kind.

#include "study/Ratings.h"
#include "study/Screening.h"
#include "study/SessionLog.h"
#include "study/Study.h"
#include "study/Words.h"
#include "study/procedures/Staircase.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
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

/// One person's answer to a question of a questionnaire.
struct ItemAnswer
{
    std::string group, participant, block, item, answer;
};

/// One person's answer to where something was felt.
struct PlaceAnswer
{
    std::string group, participant, block, stimulus;
    double place = 0.0; ///< of the stimulus, in the unit of the block's scale
    double felt = 0.0;  ///< likewise
};

/// One person's answer to how many or which events were felt at once.
struct EventAnswer
{
    std::string group, participant, block, stimulus;
    int choice = 0; ///< as Answer::choice
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
    std::vector<ItemAnswer> items;    ///< of questionnaires; what was left empty is left out
    std::vector<PlaceAnswer> places;
    std::vector<EventAnswer> events;    ///< of count and which
    std::size_t dropouts = 0;           ///< trials that were repeated
    std::optional<Screening> screening; ///< of listeners, if that was done; whom it leaves out is not in `ratings`
};

/// The name of a study's file in its folder.
inline constexpr const char* studyFileName = "study.json";

/// Returns the file of a study, given by its folder or its file.
[[nodiscard]] std::filesystem::path studyFileOf(const std::filesystem::path& named);

/// Reads a study, given by its folder or file, and its sessions. Training and trials with drop-outs do not count.
/// Errors: those of readStudy(); io if there is no session.
[[nodiscard]] Result<StudyResults> readResults(const std::filesystem::path& named);

/// Leaves only answers to stimuli of one class (see classesOf()), and pairs and pages only as far as they are of it.
/// Returns whether any stimulus of the study belongs to it.
[[nodiscard]] bool keepClass(StudyResults& results, std::string_view name);

/// The study with the paths of its files from another folder.
[[nodiscard]] Study relocated(Study study, const std::filesystem::path& from, const std::filesystem::path& to);

/// The threshold of the answers of one staircase, in their order.
[[nodiscard]] std::optional<ThresholdEstimate> thresholdOf(const Block& block, const std::vector<Record>& records);

} // namespace pacini::study
