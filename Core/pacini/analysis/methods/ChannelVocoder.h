#pragma once

// Channels of a vocoder: envelopes of ranges of hearing on carriers that skin feels.

#include <pacini/analysis/methods/MethodClip.h>
#include <pacini/analysis/methods/MethodCurves.h>
#include <pacini/analysis/methods/MethodSound.h>
#include <pacini/clip/BandPriority.h>
#include <pacini/filters/Butterworth.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// A channel: the range that is heard, and the frequency at which its envelope is felt.
struct VocoderChannel
{
    double low = 0.0;     ///< Hz
    double centre = 0.0;  ///< Hz
    double high = 0.0;    ///< Hz, below half of the sample rate
    double carrier = 0.0; ///< Hz
    bool operator==(const VocoderChannel&) const = default;
};

/// Adds a band to `clip` for each channel: the envelope behind a band-pass of sixth order (Butterworth) on the
/// channel's carrier. The carriers share one actuator, so all envelopes are scaled down together where their sum would
/// pass full drive. Returns that scale, 1 or less.
inline double addVocoderChannels(Clip& clip, const MethodSound& sound, const MethodCurveParams& curves,
                                 std::span<const VocoderChannel> channels)
{
    std::vector<Curve> tracks;
    std::vector<float> filtered(MethodSound::longestPart);
    for (const VocoderChannel& channel : channels)
    {
        Butterworth filter;
        filter.setParams({ButterworthType::bandpass, 3, Hertz(channel.low), Hertz(channel.high)});
        filter.prepare({sound.fs, MethodSound::longestPart});
        EnvelopeTrack track(curves, sound.fs);
        sound.forEachPart(
            [&](std::span<const float> part)
            {
                const auto out = std::span(filtered).first(part.size());
                filter.process(part, out);
                track.push(out);
            });
        tracks.push_back(std::move(track.curve()));
    }

    double loudest = 1.0;
    for (std::size_t i = 0; !tracks.empty() && i < tracks.front().size(); ++i)
    {
        double sum = 0.0;
        for (const Curve& track : tracks)
            sum += track[i].value;
        loudest = std::max(loudest, sum);
    }
    for (std::size_t k = 0; k < tracks.size(); ++k)
    {
        for (Breakpoint& point : tracks[k])
            point.value /= loudest;
        Band band{channels[k].low, channels[k].centre, channels[k].high, 0, methodCurve(tracks[k], sound, curves), {}};
        if (!band.amplitude.empty())
            band.pitch = {{0.0, channels[k].carrier}};
        clip.bands.push_back(std::move(band));
    }
    rankByEnergy(clip);
    return 1.0 / loudest;
}

} // namespace pacini
