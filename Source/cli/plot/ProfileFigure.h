#pragma once

// What an actuator does to the frequencies of a drive signal, as a figure.

#include "cli/plot/Figure.h"

#include <pacini/actuator/Profile.h>

namespace pacini::plot
{

/// Two panels from 10 to 1500 Hz: the felt acceleration at full drive, alone and after the output filter, with a band
/// for the simulated wearers (see bodyOn) and marks for range and resonance; and the output filter itself, which is the
/// equaliser or the inverse of the resonance as `pacini render` designs it by default. A profile without a body gets no
/// first panel, a motor no second one: its drive is a speed, not a waveform. `profile` is valid.
///
/// A motor is shown as it turns steadily: at a frequency f below its fastest, f0 times overdrive, its force is
/// (f / f0)^2 of that at the rated speed f0.
[[nodiscard]] Figure makeProfileFigure(const Profile& profile, const FigureStyle& style);

} // namespace pacini::plot
