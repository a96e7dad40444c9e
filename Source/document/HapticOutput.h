#pragma once

// A haptic output that clips play on.

#include <string>

namespace pacini
{

struct HapticOutput
{
    int channel = 2;      ///< of the device, from 0; see HapticOutputs::channelOf(); -1: none
    std::string actuator; ///< the name of a profile; empty: that of the project
    double gain = 0.0;    ///< dB, -60 (silent) to 0
    double delay = 0.0;   ///< s, 0 to 0.5
    double place = 0.0;   ///< 0 to 1, for the pan
    bool operator==(const HapticOutput&) const = default;
};

} // namespace pacini
