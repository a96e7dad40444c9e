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

/// Ratings of a table with a first line of names: stimulus and rating, and where there are any group, participant and
/// block. Fields are apart by commas or semicolons, texts may stand in quotes (RFC 4180). Errors (invalidData) at a
/// line such as `line 3`: a column that is missing, a rating that is no finite number, no rating at all.
[[nodiscard]] Result<std::vector<Rating>> ratingsOfCsv(std::string_view text);

/// The same of a file. Errors also as in readWholeFile.
[[nodiscard]] Result<std::vector<Rating>> readRatings(const std::filesystem::path& path);

/// The table of `ratings` as ratingsOfCsv() reads it.
[[nodiscard]] std::string ratingsCsv(const std::vector<Rating>& ratings);

} // namespace pacini::study
