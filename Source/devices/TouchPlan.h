#pragma once

// When a motor that is only on or off, such as a phone's, is on while a clip plays.

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Units.h>

#include <cstddef>
#include <vector>

namespace pacini::devices
{

/// The motor is on from start to end, s.
struct Touch
{
    double start = 0.0;
    double end = 0.0;
};

struct TouchPlan
{
    std::vector<Touch> touches; ///< in order, at least `touchGap` apart
    std::size_t events = 0;     ///< of the clip, as far as it is felt
    std::size_t leftOut = 0;    ///< events that come too soon after another
};

/// A shorter push of a phone's motor is not felt, and a shorter gap is not felt as one.
inline constexpr Seconds touchLength{0.035};
inline constexpr Seconds touchGap{0.020};

/// Of longer clips as much is felt.
inline constexpr Seconds longestTouched{3600.0};

/// Follows the drive signal of a valid clip. Each event is a push of its own, up to 10 ms late, with a gap before it;
/// those that come still sooner after another are left out. In between, pushes follow each other the sooner the
/// stronger the drive is, so that their share of the time is its level; near full drive the motor stays on. [worker]
[[nodiscard]] TouchPlan touchPlan(const Clip& clip);

} // namespace pacini::devices
