#include "io/formats/HjifVoices.h"

#include "io/formats/HjifFormat.h"
#include "io/formats/PlayedClip.h"
#include "io/formats/WithinShare.h"

#include <pacini/analysis/CurveFitter.h>
#include <pacini/synthesis/DecoderChoice.h>
#include <pacini/synthesis/VoiceMerge.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace pacini
{

namespace
{
constexpr double fineStep = 0.001;          // s: that of the levelling gain
constexpr double fitStep = 0.005;           // s: half of what the levelling looks at
constexpr double fitPrice = 12.0;           // dB^2 steps
constexpr double floorBelowLoudest = 0.018; // -35 dB
constexpr double markBelowBands = 0.055;    // -25 dB

/// Few points that stay within two semitones. It comes before the levelling, which undoes the beats of the waves that
/// are really played.
Curve fewPitches(Curve pitch)
{
    constexpr double semitones = 2.0;
    for (Breakpoint& point : pitch)
        point.value = std::log2(point.value);
    pitch = withinShare(pitch, 0.0, semitones / 12.0);
    for (Breakpoint& point : pitch)
        point.value = std::exp2(point.value);
    return pitch;
}

/// Root mean squares around each step.
std::vector<float> sampled(const Curve& amplitude, double duration)
{
    constexpr int around = 2; // fine steps to each side
    const auto steps = static_cast<std::size_t>(std::floor(duration / fitStep)) + 1;
    std::vector<float> track;
    CurveReader reader(amplitude);
    for (std::size_t i = 0; i < steps; ++i)
    {
        double power = 0.0;
        for (int k = -around; k <= around; ++k)
        {
            const double time = static_cast<double>(i) * fitStep + k * fineStep;
            power += std::pow(reader.at(std::clamp(time, 0.0, duration)), 2.0) / (2 * around + 1);
        }
        track.push_back(static_cast<float>(std::sqrt(power)));
    }
    return track;
}

/// Gives events that the bands reach by themselves a pulse that is hardly there.
void markCovered(Clip& played, const Clip& clip)
{
    for (std::size_t i = 0; i < played.transients.size(); ++i)
    {
        Transient& event = played.transients[i];
        const double mark = markBelowBands * hjifLevelAt(played, event.time) / hjifTransientLevel(event.sharpness);
        event.amplitude = std::max(event.amplitude, std::min(mark, clip.transients[i].amplitude));
    }
}
} // namespace

double hjifLevelAt(const Clip& clip, double time)
{
    double power = 0.0;
    for (const Band& band : clip.bands)
        power += std::pow(valueAt(band.amplitude, time), 2.0);
    return std::sqrt(power);
}

Clip hjifVoicesOf(const Clip& clip, LossList& losses)
{
    const DecoderParams decoder = decoderParamsFor(clip, {}, {}, 67.0);
    if (clip.envelope.empty() || !decoder.followEnvelope)
        return playedClip(clip, 1.0, fineStep);
    Clip few = clip;
    if (decoder.carriers == CarrierMode::pitch)
    {
        if (clip.bands.size() > hjifVoices)
            losses.add(LossKind::bands, 0.0, clip.duration, 0.0,
                       fmt::format("{} bands share {}", clip.bands.size(), hjifVoices));
        mergeVoices(few, hjifVoices);
        for (Band& band : few.bands)
            band.pitch = fewPitches(std::move(band.pitch));
    }
    Clip played = playedClip(few, 1.0, fineStep);
    markCovered(played, clip);
    double loudest = 0.0;
    for (const Band& band : played.bands)
        for (const Breakpoint& point : band.amplitude)
            loudest = std::max(loudest, point.value);
    CurveFitter fitter;
    for (Band& band : played.bands)
    {
        const std::vector<float> track = sampled(band.amplitude, clip.duration);
        if (track.size() < 3)
            continue;
        Curve fitted = fitter.fitAmplitude(track, fitStep, 1.0, floorBelowLoudest * loudest, fitPrice);
        cutAfter(fitted, clip.duration);
        for (Breakpoint& point : fitted)
            point.value = std::min(point.value, limits::amplitude);
        if (!fitted.empty() && !band.amplitude.empty())
            losses.addThinned(band.amplitude, fitted);
        band.amplitude = std::move(fitted);
    }
    return played;
}

} // namespace pacini
