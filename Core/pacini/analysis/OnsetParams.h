#pragma once

// Parameters of onset detection, without its algorithms.

#include <pacini/foundation/Units.h>

namespace pacini
{

/// Parameters of onset detection. The defaults were set on mixtures of single drum hits with known
/// times.
struct OnsetParams
{
    /// Above 1 more and weaker onsets are found (and more false ones), below 1 fewer; clamped to 0.25-4.
    double sensitivity = 1.0;

    /// Two events are never closer than this; of two closer ones the first stays. The skin separates 8-10 ms.
    Seconds minimumGap{0.010};

    /// An event less than this below its louder neighbours needs no more salience than one alone ...
    Decibels maskMargin{8.0};
    /// ... and this much more (a fraction of the threshold) for each further dB.
    double maskSlope = 0.06;
    /// Decay of masking with the distance in time of a neighbour, before and after it, dB/s.
    double maskRecovery = 20.0;
    /// An event further than this below its neighbours (with recovery) is dropped however clear it is.
    Decibels maskLimit{27.0};

    /// Events of smaller amplitude (re 1) are dropped: 16-bit dither reaches -92 dB.
    Decibels silence{-90.0};
    bool operator==(const OnsetParams&) const = default;
};

} // namespace pacini
