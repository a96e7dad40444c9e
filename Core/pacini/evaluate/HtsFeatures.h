#pragma once

// Features of one signal for the haptic translation similarity.

#include <array>
#include <cstddef>
#include <vector>

namespace pacini
{

/// Features of one mono signal at 4 kHz, divided by a power of two near its peak. "Felt" is the signal behind the
/// weighting of the skin (20-300 Hz), "audible" the signal above 20 Hz. Envelopes are linear, one value per 5 ms.
struct HtsFeatures
{
    static constexpr int sampleRate = 4000;            ///< Hz
    static constexpr std::size_t envelopeSpacing = 20; ///< samples: 5 ms
    static constexpr std::size_t bandCount = 5;        ///< edges 25, 60, 125, 250, 500, 1000 Hz
    static constexpr std::size_t lowCount = 2;         ///< edges 30, 120, 300 Hz
    static constexpr std::size_t spectrumCount = 21;   ///< from 25 Hz in ratios of 1.2

    double duration = 0.0;                                  ///< s
    std::vector<float> felt;                                ///< envelope
    std::vector<float> audible;                             ///< envelope; only of a source
    std::array<std::vector<float>, bandCount> bands;        ///< envelopes of the felt signal
    std::array<std::vector<float>, lowCount> low;           ///< envelopes of the audible signal, for LowPart
    std::vector<std::array<float, spectrumCount>> spectrum; ///< amplitudes of the felt signal, frames of 64 ms
    std::vector<double> feltEvents;                         ///< s
    std::vector<double> audibleEvents;                      ///< s; only of a source
};

} // namespace pacini
