#pragma once

// Conversion of an HJIF file's effects to bands and events of a clip.

#include "io/formats/ImportReport.h"
#include "io/formats/hjif/HjifFile.h"

#include <pacini/clip/Clip.h>

#include <optional>
#include <string>

namespace pacini
{

/// Units of an effect's numbers.
struct HjifScale
{
    double ticks = 1000.0; ///< per second
    double level = 1.0;    ///< amplitude of 1
};

/// An effect of a band, resolved, and its position.
struct HjifPlaced
{
    const HjifEffect* effect = nullptr;
    double position = 0.0; ///< ticks
};

/// The event that a short wave of one frequency stands for, which rises from 0 and falls back to it; none for others.
/// Its sharpness is the one that the decoder plays with this frequency: pulses in fast trains have more periods.
/// `position` in ticks.
[[nodiscard]] std::optional<Transient> hjifPulse(const HjifEffect& effect, double position, const HjifScale& scale);

/// Appends a wave at `position` ticks to `lane`. Changes are reported to `report` at `where`.
void appendHjifWave(Band& lane, const HjifEffect& effect, double position, const HjifBand& band, const HjifScale& scale,
                    ImportReport& report, const std::string& where);

/// Likewise a waveform that is drawn through its extrema: between two of them lies half a period.
void appendHjifCurve(Band& lane, const HjifEffect& effect, double position, const HjifScale& scale);

/// Gives a band that holds all its waves the frequencies of `band` and of its pitch, which goes where it stands still.
void setHjifFrequencies(Band& lane, const HjifBand& band);

} // namespace pacini
