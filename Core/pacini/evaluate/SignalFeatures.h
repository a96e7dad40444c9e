#pragma once

// Features for the judge measures: what they need to know of one signal.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace pacini
{

/// The envelope of one band, linear amplitude, one value per `spacing` samples of 8 kHz.
struct BandEnvelope
{
    std::size_t spacing = 0;
    std::vector<float> values;
};

/// Features of one mono signal, divided by `scale`; "in band" is 30-1000 Hz by a zero-phase Butterworth band-pass of
/// order 4.
struct SignalFeatures
{
    static constexpr int sampleRate = 8000;             ///< Hz
    static constexpr std::size_t envelopeSpacing = 8;   ///< samples per value of `wide`: 1 kHz
    static constexpr std::size_t frameSpacing = 80;     ///< samples per frame of the spectral features: 100 Hz
    static constexpr std::size_t bandCount = 12;        ///< log-spaced over 30-1000 Hz
    static constexpr std::size_t thirdOctaveCount = 16; ///< centres 31.25-1000 Hz

    std::size_t length = 0;          ///< samples at 8 kHz
    std::size_t nonFinite = 0;       ///< samples at 8 kHz that were NaN or infinite and count as 0
    double scale = 1.0;              ///< a power of two near the signal's peak
    double rms = 0.0;                ///< in band
    std::optional<double> outOfBand; ///< dB, energy outside the band over energy inside; empty for silence
    std::vector<float> wide;         ///< envelope in band
    std::array<BandEnvelope, bandCount> bands;
    std::array<std::vector<float>, thirdOctaveCount> thirdOctaves; ///< mean powers of 20 ms frames
    std::vector<float> framePower; ///< of 64 ms Hann frames, 30-1000 Hz, in an arbitrary but fixed unit
    std::vector<float> centroid;   ///< Hz, of the same frames; 0 for silence
    std::vector<double> onsets;    ///< s, by the neutral detector
};

} // namespace pacini
