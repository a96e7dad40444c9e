#pragma once

// Report of a study: its statistics as a page and as JSON.

#include "cli/study/Page.h"
#include "study/RatingAnalysis.h"
#include "study/StudyResults.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace pacini::cli
{

struct StudyReportParams
{
    std::vector<study::GroupUnion> unions;
    std::optional<study::WordCategories> categories;
    std::optional<study::WordCategories> otherCategories; ///< of a second coder, to be compared with the first
    bool mixed = false;                                   ///< also fit mixed models, by Python
    bool pairStimuli = true;                              ///< as in RatingAnalysisParams
};

/// Ratings of another program's table, and what was said when they were read.
struct RatedTable
{
    std::vector<study::Rating> ratings;
    std::vector<std::string> warnings;
    std::optional<study::Screening> screening; ///< as in StudyResults
};

struct StudyReport
{
    Page page;
    nlohmann::ordered_json json;
    std::vector<std::string> warnings; ///< about the sample of people; those of reading are not among them
    std::vector<std::string> methods;  ///< sentences about the tests that were used, each once
};

/// Errors: those of drawing pictures and of fitMixedModel().
[[nodiscard]] Result<StudyReport> reportOfRatings(const RatedTable& table, const std::string& title,
                                                  const StudyReportParams& params);

/// Of everything in a study's folder.
[[nodiscard]] Result<StudyReport> reportOfStudy(const study::StudyResults& results, const StudyReportParams& params);

} // namespace pacini::cli
