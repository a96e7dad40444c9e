#pragma once

// Share of right answers of several people, each of whom has answered several times.

#include "study/statistics/Sample.h"

#include <cstddef>
#include <span>

namespace pacini::study
{

/// Answers of one person.
struct CountedAnswers
{
    std::size_t right = 0, all = 0;
};

struct Proportion
{
    std::size_t right = 0, all = 0;
    double share = 0.0;
    Interval share95; ///< holds for people like these; of one person for that person alone
};

/// Share of all answers, and its interval: Wilson's (1927) with the effective number of answers, that is their number
/// divided by the design effect (at least 1), and the quantile of Student's t, as Korn and Graubard (1998) have it for
/// clustered samples. Answers of one person are alike: counted as if each were another person's, they make intervals
/// far too narrow. All zero without answers.
[[nodiscard]] Proportion proportionOf(std::span<const CountedAnswers> people);

} // namespace pacini::study
