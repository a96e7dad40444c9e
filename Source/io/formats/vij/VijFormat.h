#pragma once

// .vij files of Lofelt Studio Desktop, data model 0.2: the forerunner of .haptic, as JSON.

#include "io/formats/ClipFormat.h"

namespace pacini
{

[[nodiscard]] bool isVij(std::string_view bytes);

/// Reads the envelopes of amplitude and frequency and the transients of `voices`. As Lofelt's own upgrade to .haptic
/// does, the last amplitude holds until the stated duration; other than that upgrade, which drops transients that stand
/// at no point of the amplitude, all are kept. Values outside of 0 to 1 are moved there with a warning; what stands in
/// `variation` and `voices.bands` is not kept. Errors: as in readForeignTree(), and invalidData with its path for
/// missing or mistyped entries, no amplitude point, times below 0, going back or beyond 24 hours.
[[nodiscard]] Result<ImportedClip> readVij(std::string_view bytes);

} // namespace pacini
