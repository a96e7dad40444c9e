#pragma once

// The entries of an MPEG haptics file for a clip, before they are written as text or as bits.

#include "io/formats/ClipFormat.h"
#include "io/formats/LossList.h"
#include "io/formats/hjif/HjifFile.h"

#include <limits>

namespace pacini
{

/// Limits of the file that the entries are written to.
struct HjifModelParams
{
    double lowestGain = 1.0; ///< of the channel; below 1 where amplitudes have few steps, which a quiet clip then uses
    double gainSteps = 1000.0;                                      ///< gains are multiples of 1 / gainSteps
    double longestEffect = std::numeric_limits<double>::infinity(); ///< s; a longer wave goes on in a further effect
};

/// One perception with one channel, in ms and Hz without fraction. Levelled clips become a few VectorialWave bands of
/// few keyframes (see hjifVoicesOf), others one for each of their bands with all of its points. See writeHjif() for
/// events and `params`. `losses` gets what a clip loses by that.
[[nodiscard]] HjifFile hjifModelOf(const Clip& clip, const ExportParams& params, LossList& losses,
                                   const HjifModelParams& limits = {});

/// The profile and level of a file with as many bands in a channel: 7 are the most of Simple Parametric.
struct HjifProfile
{
    const char* name;
    int level;
};
[[nodiscard]] HjifProfile hjifProfileOf(const HjifFile& file);

} // namespace pacini
