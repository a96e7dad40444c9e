#pragma once

// Limiter of the sum of a clip's bands, to full drive.

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>

#include <cstddef>

namespace pacini
{

/// Scales the amplitudes of `bands` where they add up to more than `most`, all by the same factor at a time, so that
/// they add up to `most` there, as a player's output does that has no more to give. Points are added only to what
/// sounds where it is too loud. Whether anything was. Errors: tooLarge when that takes more than `maxPoints`.
[[nodiscard]] Result<bool> limitSum(std::vector<Band>& bands, double most, std::size_t maxPoints);

} // namespace pacini
