#pragma once

// Cue sheets: texts that name the tracks of one long sound.

#include "io/FoundMarkers.h"

#include <pacini/foundation/Result.h>

#include <string_view>

namespace pacini
{

/// Whether a text is a cue sheet: it has a line FILE and a line INDEX.
[[nodiscard]] bool isCueSheet(std::string_view text);

/// The tracks of the first sound that a cue sheet names as markers at their INDEX 01, called by their titles or
/// numbers; further indices have theirs behind the title. A time is minutes, seconds and frames of 1/75 s. Warnings:
/// tracks of other sounds. Error: invalidData for a time that cannot be read, with its line. Source: CDRWIN User's
/// Guide 3.8, appendix A, 2000.
[[nodiscard]] Result<FoundMarkers> readCueSheet(std::string_view text);

} // namespace pacini
