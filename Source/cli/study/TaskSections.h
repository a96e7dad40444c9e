#pragma once

// Sections of a study's report: questionnaires, places on the skin, events at once, classes of stimuli.

#include "cli/study/ReportWriter.h"
#include "study/StudyResults.h"

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace pacini::cli
{

/// A number for each person.
struct PersonalMeasure
{
    std::string name;
    std::map<Person, double> values;
};

/// Counts, means and SDs of the answers to each question.
void writeQuestionnaires(ReportWriter& writer, nlohmann::ordered_json& json, const study::StudyResults& results);

/// Results of each person in one number: thresholds, errors of places, shares of right answers.
[[nodiscard]] std::vector<PersonalMeasure> measuresOf(const study::StudyResults& results);

/// The mean rating of each person.
[[nodiscard]] PersonalMeasure meanRatings(const std::string& title, const std::vector<study::Rating>& ratings);

/// Correlations of the numbers in questionnaires with the results.
void writeCovariates(ReportWriter& writer, nlohmann::ordered_json& json, const study::StudyResults& results,
                     const std::vector<PersonalMeasure>& measures);

/// Where touches were felt: means, errors and SDs for each stimulus, and for each way of placing. Errors: those of
/// drawing pictures.
[[nodiscard]] Result<void> writePlaces(ReportWriter& writer, nlohmann::ordered_json& json,
                                       const study::StudyResults& results);

/// How many and which events were felt at once, and what was taken for what.
void writeEvents(ReportWriter& writer, nlohmann::ordered_json& json, const study::StudyResults& results);

/// Ratings by the classes and tags of the stimuli.
void writeClasses(ReportWriter& writer, nlohmann::ordered_json& json, const study::Study& study,
                  const std::vector<study::Rating>& ratings, const std::string& title);

} // namespace pacini::cli
