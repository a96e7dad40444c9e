#pragma once

// Profiles with the thresholds of a person.

#include "study/StudyResults.h"

#include <pacini/actuator/Profile.h>

#include <string_view>

namespace pacini::study
{

/// `profile` for the participant: its dynamic range, from full drive down to what is just felt, is that of the person's
/// thresholds of detection. Each is a drive behind the equaliser, and counts by the level before it; of the frequencies
/// within the actuator's range the mean counts, 1 to 140 dB. Weak parts of clips are then raised to what this person
/// feels (see ClipAdaptation). Errors: invalidArgument for a participant without such a threshold in the range, and for
/// one that was found at the end of what was asked, where it is not known.
[[nodiscard]] Result<Profile> personalProfile(const Profile& profile, const StudyResults& results,
                                              std::string_view participant);

} // namespace pacini::study
