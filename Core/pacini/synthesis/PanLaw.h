#pragma once

// Pan law: how a position in a row of actuators counts.

namespace pacini
{

/// Pan law: placement of a play between actuators, which form a row from pan 0 to pan 1.
enum class PanLaw
{
    constantPower, ///< by level between the two nearest actuators; the power stays
    delay,         ///< by time: equal levels, and the farther an actuator the later
    both
};

} // namespace pacini
