#pragma once

// The translation "vocoder16": sixteen third-octave channels of hearing, all played at one pitch that skin feels well.

#include <pacini/analysis/methods/ChannelVocoder.h>
#include <pacini/analysis/methods/MethodClip.h>
#include <pacini/analysis/methods/MethodCurves.h>
#include <pacini/analysis/methods/MethodSound.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace pacini
{

/// Parameters of "vocoder16".
struct ThirdOctaveVocoderParams
{
    BandLimitParams range{Hertz(5.0), Hertz(std::numeric_limits<double>::infinity())};
    MethodCurveParams curves;
    Hertz lowestCentre{200.0}; ///< 1 Hz and above
    std::size_t channels = 16; ///< clamped to 1-32; those that reach above 0.45 of the sample rate are left out
    Hertz carrier{100.0};      ///< clamped to 1 Hz to 0.45 of the sample rate
    bool operator==(const ThirdOctaveVocoderParams&) const = default;
};

/// The tactile vocoder for speech that the thesis reviews (Weber 2020, section 1.3): each channel's envelope modulates
/// a carrier of 100 Hz. There each channel had its own actuator; here the carriers share one, in phase. They were
/// square waves, of which only the fundamental is left. Channels are third octaves of the base-two series (IEC 61260).
/// `mono` may have any length, fs is 8000 to 768000 Hz.
[[nodiscard]] inline Clip thirdOctaveVocoderClip(std::span<const float> mono, double fs,
                                                 const ThirdOctaveVocoderParams& params = {})
{
    const MethodSound sound = prepareSound(mono, fs, params.range);
    Clip clip = startMethodClip("vocoder16", sound, params.curves);
    const double carrier = clampTo(params.carrier.value, 1.0, 0.45 * fs);
    const double toEdge = std::exp2(1.0 / 6.0);
    std::vector<VocoderChannel> channels;
    for (std::size_t k = 0; k < clampTo<std::size_t>(params.channels, 1, 32); ++k)
    {
        const double centre = std::max(1.0, params.lowestCentre.value) * std::exp2(static_cast<double>(k) / 3.0);
        if (centre * toEdge > 0.45 * fs)
            break;
        channels.push_back({centre / toEdge, centre, centre * toEdge, carrier});
    }
    const double gain = addVocoderChannels(clip, sound, params.curves, channels);
    clip.encoder.push_back({"bands", static_cast<double>(clip.bands.size())});
    clip.encoder.push_back({"carrier", carrier});
    clip.encoder.push_back({"channelGain", gain});
    return clip;
}

} // namespace pacini
