#pragma once

// Waveform of events.

namespace pacini
{

/// Waveform of events.
enum class TransientShape
{
    adaptive, ///< smooth pulses that are over before the next event comes, whatever the event rate
    square,   ///< +1 in the first half of each period, -1 in the second (Weber 2020: one cycle at the actuator's
              ///< resonance)
    sine      ///< plain sine periods
};

} // namespace pacini
