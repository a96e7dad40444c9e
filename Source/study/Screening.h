#pragma once

// Screening of listeners by the hidden reference of multi-stimulus tests (MUSHRA).

#include "study/Ratings.h"
#include "study/Study.h"

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pacini::study
{

/// One listener's ratings of hidden references.
struct ScreenedListener
{
    std::string group, participant;
    std::size_t trials = 0; ///< with a hidden reference
    std::size_t below = 0;  ///< of these, rated below the criterion
    [[nodiscard]] double share() const noexcept { return static_cast<double>(below) / static_cast<double>(trials); }
};

/// Who is left out by ITU-R BS.1534-3, 4.1.2: who rates the hidden reference below 90 (of 0 to 100) in more than 15 %
/// of the trials.
struct Screening
{
    std::vector<std::string> references;    ///< the stimuli that are hidden references
    std::vector<ScreenedListener> everyone; ///< who has rated one
    std::vector<ScreenedListener> failed;   ///< who would be left out
    bool kept = false;                      ///< nobody was left out: as was requested, or as nobody would remain
    bool nobodyPassed = false;
};

inline constexpr double screeningShare = 0.15; ///< of the trials
inline constexpr double screeningLevel = 0.9;  ///< of the scale

/// The rating of a hidden reference that must be reached; none if the rating is of something else.
using ReferenceCriterion = std::function<std::optional<double>(const Rating&)>;

/// Finds who fails, and unless `keep` removes their ratings of all blocks in which `isScreened`. None without a rating
/// of a hidden reference.
[[nodiscard]] std::optional<Screening> screenListeners(std::vector<Rating>& ratings,
                                                       const ReferenceCriterion& criterion,
                                                       const std::function<bool(const Rating&)>& isScreened, bool keep);

/// The same of a study's multi-stimulus blocks, by their references and scales.
[[nodiscard]] std::optional<Screening> screenListeners(std::vector<Rating>& ratings, const Study& study, bool keep);

/// The same of a table of ratings from 0 to 100, with these hidden references. Errors: invalidArgument if nobody has
/// rated one of them, or if a rating is beyond 0 to 100.
[[nodiscard]] Result<std::optional<Screening>> screenListeners(std::vector<Rating>& ratings,
                                                               const std::vector<std::string>& references, bool keep);

} // namespace pacini::study
