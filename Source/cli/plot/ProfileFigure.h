#pragma once

// Figure of an actuator profile: felt acceleration and output filter over frequency.

#include "cli/plot/Figure.h"

#include <pacini/actuator/Profile.h>

namespace pacini::plot
{

/// Two panels from 10 to 1500 Hz with marks for range and resonance: the felt acceleration at full drive, alone and
/// after the output filter, with a thin line for each simulated wearer (see bodyOn); and the output filter itself,
/// which is the equaliser or the inverse of the resonance as `pacini render` designs it by default. A profile without a
/// body gets no first panel, a motor with one no second: its drive is a speed, not a waveform. `profile` is valid.
///
/// A motor is shown as it turns steadily, from the speed at which it stalls to what its overdrive reaches: its force is
/// (f / f0)^2 of that at the rated speed f0.
[[nodiscard]] Figure makeProfileFigure(const Profile& profile, const FigureStyle& style);

} // namespace pacini::plot
