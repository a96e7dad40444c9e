#pragma once

// Ratings as they were given, and their file for other programs.

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::study
{

/// One answer on a scale.
struct Rating
{
    std::string group;
    std::string participant; ///< within the group
    std::string block;       ///< which part of the study; may be empty
    std::string stimulus;
    double value = 0.0;
};

/// More are no study of people.
inline constexpr std::size_t mostRatings = 1'000'000;

/// Names of a table's columns, whatever the case of their letters; empty: the usual ones.
struct RatingColumns
{
    std::string group, participant, block, stimulus, rating;
};

/// Ratings of a table with a first line of names: stimulus and rating, and where there are any group, participant and
/// block; or those of webMUSHRA (session_uuid, trial_id, rating_stimulus, rating_score), of jsPsych (stimulus,
/// response) and the like. Fields are apart by tabs, semicolons or commas, as the first line has them; texts may stand
/// in quotes (RFC 4180), and numbers may have a decimal comma. What is not UTF-8 is Latin-1, which `warnings` says.
/// Lines without a rating (empty, NA, NaN, null) or a stimulus, those without a participant or a group where others
/// have one, and those of jsPsych that are not of a slider where others are, are left out and counted in `warnings`.
/// `isWebMushra` becomes whether the stimuli are in a column of webMUSHRA. Errors (invalidData) at a line
/// such as `line 3`: UTF-16, a column that is missing or of which there are several, a line that is too long, a rating
/// that is no finite number, no rating at all.
[[nodiscard]] Result<std::vector<Rating>> ratingsOfCsv(std::string_view bytes, const RatingColumns& columns = {},
                                                       std::vector<std::string>* warnings = nullptr,
                                                       bool* isWebMushra = nullptr);

/// The same of a file. Errors also as in readWholeFile.
[[nodiscard]] Result<std::vector<Rating>> readRatings(const std::filesystem::path& path,
                                                      const RatingColumns& columns = {},
                                                      std::vector<std::string>* warnings = nullptr,
                                                      bool* isWebMushra = nullptr);

/// The table of `ratings` as ratingsOfCsv() reads it.
[[nodiscard]] std::string ratingsCsv(const std::vector<Rating>& ratings);

} // namespace pacini::study
