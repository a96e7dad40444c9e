#pragma once

// Limiter of the sum of a clip's bands, to full drive.

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>

#include <cstddef>

namespace pacini
{

/// Scales the amplitudes of `bands` where their sum exceeds `most`, all by the same factor at a time, so that the sum
/// is `most` there, as in a player whose output is limited. Adds points only where the sum is too large. Returns
/// whether anything changed. Errors: tooLarge if that takes more than `maxPoints`.
[[nodiscard]] Result<bool> limitSum(std::vector<Band>& bands, double most, std::size_t maxPoints);

} // namespace pacini
