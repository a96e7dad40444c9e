#pragma once

// Check of a study for problems before participants are invited.

#include "study/Stimuli.h"

#include <functional>
#include <string>
#include <vector>

namespace pacini::study
{

struct Finding
{
    bool spoils = false; ///< the study cannot be run so; otherwise something to think about
    std::string where;   ///< such as `blocks[1]`
    std::string message;
};

/// Sequence of trials for a participant of a group.
struct GroupLoad
{
    std::string group;
    std::size_t trials = 0;
    double minutes = 0.0;  ///< with answers and one replay of every second trial, breaks aside
    double exposure = 0.0; ///< A(8), m/s2
};

struct StudyCheck
{
    std::vector<Finding> findings;
    std::vector<GroupLoad> loads;
    bool exposureIsAssumed = false; ///< the profile does not tell what is felt
};

/// Makes all stimuli and looks for what is missing, too long, too much, uneven, or cannot be told apart.
/// `progress(share)` is called now and then.
[[nodiscard]] StudyCheck checkStudy(const Study& study, const StimulusParams& params,
                                    const std::function<void(double)>& progress);

/// Energy of the difference of two signals in dB re the mean of theirs; what is longer counts against silence.
/// -infinity for equal ones.
[[nodiscard]] double differenceDecibels(const std::vector<float>& a, const std::vector<float>& b);

} // namespace pacini::study
