#pragma once

// Default strength: the balance of likeness and felt level on resonant actuators.

namespace pacini
{

/// The default strength. It costs at most 3 dB of felt level against the unflattened actuator, and keeps at least two
/// thirds of the likeness gained by adaptation: chosen on thirty recordings with `pacini bench actuators`. This holds
/// for each shipped profile except the DualSense (q 1.7), for which adaptation gains little.
inline constexpr double standardStrength = 0.4;

} // namespace pacini
