#pragma once

// The translation "modulation": ranges of hearing, each as the strength of a sine of its own that skin feels.

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

/// Parameters of "modulation". Ranges and carriers are evenly spaced in octaves.
struct ModulationParams
{
    BandLimitParams range{Hertz(5.0), Hertz(std::numeric_limits<double>::infinity())};
    MethodCurveParams curves;
    Hertz lowest{100.0};       ///< of what is heard, 1 Hz and above
    Hertz highest{8000.0};     ///< of what is heard, an octave above `lowest` or more; 0.45 of the sample rate ends it
    std::size_t channels = 4;  ///< clamped to 1-16
    Hertz lowestCarrier{60.0}; ///< clamped to 1 Hz to 0.45 of the sample rate
    Hertz highestCarrier{400.0}; ///< clamped to `lowestCarrier` to 0.45 of the sample rate
    bool operator==(const ModulationParams&) const = default;
};

/// Amplitude modulation for people who do not hear, the principle that the thesis reviews (Weber 2020, section 1.3) of
/// P. Ranjbar, D. Stranneby, E. Borg, "Vibrotactile identification of signal-processed sounds from environmental
/// events", JRRD 46 (2009): sounds of everyday life were told apart better from modulated carriers than from the sound
/// itself. All that hearing has, not only what lies in the range of touch, becomes levels of a few carriers between
/// which skin tells apart. Ranges and carriers are ours; a carrier is 1.9 times the one below, several times what skin
/// just tells apart. `mono` may have any length, fs is 8000 to 768000 Hz.
[[nodiscard]] inline Clip modulationClip(std::span<const float> mono, double fs, const ModulationParams& params = {})
{
    const MethodSound sound = prepareSound(mono, fs, params.range);
    Clip clip = startMethodClip("modulation", sound, params.curves);
    const std::size_t count = clampTo<std::size_t>(params.channels, 1, 16);
    const double lowest = clampTo(params.lowest.value, 1.0, 0.2 * fs);
    const double highest = std::max(params.highest.value, 2.0 * lowest);
    const double lowCarrier = clampTo(params.lowestCarrier.value, 1.0, 0.45 * fs);
    const double highCarrier = clampTo(params.highestCarrier.value, lowCarrier, 0.45 * fs);
    const auto edge = [&](std::size_t k)
    {
        return lowest * std::pow(highest / lowest, static_cast<double>(k) / static_cast<double>(count));
    };
    std::vector<VocoderChannel> channels;
    for (std::size_t k = 0; k < count && edge(k) < 0.4 * fs; ++k)
    {
        const double low = edge(k);
        const double high = std::min(edge(k + 1), 0.45 * fs);
        const double part = count > 1 ? static_cast<double>(k) / static_cast<double>(count - 1) : 0.0;
        channels.push_back({low, std::sqrt(low * high), high, lowCarrier * std::pow(highCarrier / lowCarrier, part)});
    }
    const double gain = addVocoderChannels(clip, sound, params.curves, channels);
    clip.encoder.push_back({"bands", static_cast<double>(clip.bands.size())});
    clip.encoder.push_back({"lowestCarrier", lowCarrier});
    clip.encoder.push_back({"highestCarrier", highCarrier});
    clip.encoder.push_back({"channelGain", gain});
    return clip;
}

} // namespace pacini
