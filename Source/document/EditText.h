#pragma once

// Descriptions of hand edits in words, for lists of them.

#include "document/Edit.h"

#include <optional>
#include <string>

namespace pacini
{

/// What an edit does, such as "Points of the band at 120 Hz" or "Fade in".
[[nodiscard]] std::string editTitle(const Edit& edit);

/// Where it works, in s of the clip before it; none for edits of the whole clip.
[[nodiscard]] std::optional<TimeRange> editTime(const Edit& edit);

} // namespace pacini
