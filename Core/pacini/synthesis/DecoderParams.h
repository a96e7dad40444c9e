#pragma once

// Parameters of the clip decoder.

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Portable.h>
#include <pacini/synthesis/EventGaps.h>
#include <pacini/synthesis/Roles.h>
#include <pacini/synthesis/TransientPulse.h>
#include <pacini/synthesis/Variation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pacini
{

/// Carrier frequency mode: frequency of a band's sinusoid.
enum class CarrierMode
{
    fixed,    ///< at the band's centre frequency
    pitch,    ///< on the band's pitch curve, at the centre where there is none
    centroid, ///< all bands move with the clip's centroid, in the ratios of their centres (Weber 2020, section 4.3.3)
    none,     ///< no sinusoids: the sum of the amplitudes itself, for motors
};

/// Parameters of the decoder. Values outside their ranges are clamped to the nearest end, those that are not finite to
/// the default.
struct DecoderParams
{
    double sampleRate = 48000.0; ///< Hz, 2000 to 768000; a clip at any other rate has no frames
    CarrierMode carriers = CarrierMode::pitch;
    bool followEnvelope = true; ///< level the sum of the bands to the clip's total envelope
    bool fullRate = false;      ///< compute carriers at the output rate instead of a quarter of their required rate
    PulseParams pulses;
    EventGapParams gaps; ///< where the sum is levelled to the envelope
    VariationParams variation;
    double transposition = 0.0; ///< semitones, -96 to 96
    double stretch = 1.0;       ///< 2 = twice as long; pitches stay; 0.001 to 1000
    double gain = 1.0;          ///< linear, 0 to 1000
    double delay = 0.0;         ///< s of silence before the clip, 0 to 3600
    double headroom = 0.0;      ///< largest rise of the transposition by changes during playback, semitones, 0 to 192
    double reach = 0.0;         ///< Hz; the inner rate is made for the clip's frequencies and at least this
    bool apart = false;         ///< tones and noise may get levels of their own: see Decoder::process()
    PerRole<bool> leftOut;      ///< roles that are not computed; roles levelled together with them keep their share
    bool operator==(const DecoderParams&) const = default;
};

/// Change of pitch and speed: from `time` on a clip plays at another pitch and speed.
struct DecoderChange
{
    double time = 0.0;          ///< s of the output
    double transposition = 0.0; ///< semitones
    double stretch = 1.0;
    bool operator==(const DecoderChange&) const = default;
};

/// Geometric mean of the band centres, Hz; 1 without bands.
[[nodiscard]] inline double referenceFrequency(const Clip& clip)
{
    double sum = 0.0;
    for (const Band& band : clip.bands)
        sum += portable::log(std::max(band.centreFrequency, 1e-3));
    return clip.bands.empty() ? 1.0 : portable::exp(sum / static_cast<double>(clip.bands.size()));
}

/// The highest frequency that a clip's sinusoids and noise reach, Hz, at least 50.
[[nodiscard]] inline double highestFrequency(const Clip& clip, CarrierMode carriers)
{
    double highest = 50.0;
    for (const NoiseBand& band : clip.noise)
        highest = std::max(highest, band.highFrequency);
    for (const Band& band : clip.bands)
    {
        highest = std::max(highest, band.centreFrequency);
        if (carriers == CarrierMode::pitch)
            for (const Breakpoint& point : band.pitch)
                highest = std::max(highest, point.value);
    }
    if (carriers == CarrierMode::centroid)
        for (const Breakpoint& point : clip.centroid)
            highest = std::max(highest, point.value * highest / std::max(1.0, referenceFrequency(clip)));
    return highest;
}

/// Content of a decoder, with its skipped, imperceptible parts.
struct DecoderReport
{
    double innerRate = 0.0; ///< Hz at which the sinusoids are summed
    std::size_t carriers = 0;
    std::size_t silentBands = 0; ///< left out
    std::size_t noiseBands = 0;
    bool levelled = false;
    std::size_t pulses = 0;
    std::size_t maskedTransients = 0; ///< left out: the bands reach their level
};

/// The readings of the thesis: fixed centres, one square cycle at the actuator's resonance on top, no levelling.
[[nodiscard]] inline DecoderParams thesisDecoderParams(double sampleRate, double resonance = 67.0)
{
    DecoderParams params;
    params.sampleRate = sampleRate;
    params.carriers = CarrierMode::fixed;
    params.followEnvelope = false;
    params.fullRate = true;
    params.pulses = {TransientShape::square, resonance, 1.0};
    return params;
}

} // namespace pacini
