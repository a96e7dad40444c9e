#pragma once

// The usual trade of strength for likeness.

namespace pacini
{

/// The strength that costs at most 3 dB of felt level against an actuator that is not flattened, and keeps at least two
/// thirds of what adaptation gains in likeness: chosen on thirty recordings with `pacini bench actuators`. That holds
/// on each shipped profile but the DualSense's (q 1.7), where adaptation gains next to nothing.
inline constexpr double standardStrength = 0.4;

} // namespace pacini
