#pragma once

// Check of a study for problems before participants are invited.

#include "study/SoundLevel.h"
#include "study/Stimuli.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pacini::study
{

struct Finding
{
    bool spoils = false; ///< the study cannot run; otherwise advice
    std::string where;   ///< such as `blocks[1]`
    std::string message;
};

/// Sequence of trials for a participant of a group.
struct GroupLoad
{
    std::string group;
    std::size_t trials = 0;
    double minutes = 0.0;             ///< with answers and one replay of every second trial, breaks aside
    double exposure = 0.0;            ///< A(8), m/s2
    std::optional<double> soundDaily; ///< L_EX,8h, dB(A); none without a calibration or without sound
};

/// Level of the sound of a stimulus.
struct HeardStimulus
{
    std::string stimulus;
    SoundLevels levels;
    std::optional<double> soundPressure, weighted; ///< dB SPL and dB(A); none without a calibration
};

struct StudyCheck
{
    std::vector<Finding> findings;
    std::vector<GroupLoad> loads;
    std::vector<HeardStimulus> heard; ///< those that are not silent
    bool exposureIsAssumed = false;   ///< the profile has no body model
};

/// Makes all stimuli and checks the study for missing, too long, excessive, uneven and indistinguishable content.
/// `progress(share)` is called repeatedly.
[[nodiscard]] StudyCheck checkStudy(const Study& study, const StimulusParams& params,
                                    const std::function<void(double)>& progress);

/// Returns the energy of the difference of two signals in dB re the mean of theirs; the excess of a longer one is
/// compared with silence. -infinity for equal ones.
[[nodiscard]] double differenceDecibels(const std::vector<float>& a, const std::vector<float>& b);

/// The same of two touches, over all actuators.
[[nodiscard]] double touchDifference(const PreparedStimulus& a, const PreparedStimulus& b);

} // namespace pacini::study
