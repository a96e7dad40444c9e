#pragma once

// Simplification of a clip's lanes to a share of their points.

#include <pacini/clip/Clip.h>
#include <pacini/clip/edits/Lane.h>
#include <pacini/foundation/Result.h>

#include <cstddef>
#include <span>

namespace pacini
{

/// Cost of a simplification.
struct SimplifyCost
{
    std::size_t before = 0, after = 0; ///< points
    double amplitudeError = 0.0;       ///< largest, linear
    double frequencyError = 0.0;       ///< largest, Hz
};

struct SimplifyResult
{
    Clip clip;
    SimplifyCost cost;
};

/// Keeps about `share` (0 to 1) of the points of each lane of `lanes`, at least two. Errors: those of simplify().
[[nodiscard]] Result<SimplifyResult> keepShare(Clip clip, std::span<const Lane> lanes, double share);

} // namespace pacini
