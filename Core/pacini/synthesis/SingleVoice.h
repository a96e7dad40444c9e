#pragma once

// Reduction to one voice: a clip of many bands as one amplitude, one frequency, events.

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Portable.h>
#include <pacini/synthesis/PulseLevel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pacini
{

/// Content of formats with a single sinusoid. The curves start at 0 and end at the duration.
struct SingleVoice
{
    double duration = 0.0; ///< s
    Curve amplitude;       ///< linear, 1 = full drive
    Curve frequency;       ///< Hz; empty where the clip says nothing of it
    std::vector<Transient> events;
    Curve displaced; ///< the amplitude, at each time, that the voice plays more than a third of an octave from where
                     ///< the clip has it; empty for a clip of one band
};

/// Whether the clip is one voice already: at most one band, no noise, no envelope over them. Such a clip loses nothing
/// in singleVoiceOf().
[[nodiscard]] inline bool isSingleVoice(const Clip& clip) noexcept
{
    return clip.bands.size() <= 1 && clip.noise.empty() && clip.envelope.empty();
}

namespace detail
{
/// `curve` with points at 0 and at `duration`, where the nearest value holds.
inline Curve overWholeTime(Curve curve, double duration)
{
    if (curve.empty())
        return curve;
    for (Breakpoint& point : curve)
        point.time = std::clamp(point.time, 0.0, duration);
    if (curve.front().time > 0.0)
        curve.insert(curve.begin(), {0.0, curve.front().value});
    if (curve.back().time < duration)
        curve.push_back({duration, curve.back().value});
    return curve;
}

/// The times at which any curve of the clip bends, each once, no two nearer than 1 ms to each other except the two
/// sides of steps: those are told by a time just before.
inline std::vector<double> bendTimes(const Clip& clip)
{
    constexpr double nearest = 0.001; // s
    std::vector<double> all{0.0, clip.duration};
    std::vector<double> steps;
    const auto add = [&](const Curve& curve)
    {
        for (std::size_t i = 0; i < curve.size(); ++i)
        {
            const double time = std::min(curve[i].time, clip.duration);
            all.push_back(time);
            if (i > 0 && curve[i - 1].time == curve[i].time)
                steps.push_back(time);
        }
    };
    add(clip.envelope);
    for (const Band& band : clip.bands)
    {
        add(band.amplitude);
        add(band.pitch);
    }
    for (const NoiseBand& band : clip.noise)
        add(band.amplitude);
    if (clip.bands.empty())
        add(clip.centroid);
    std::sort(all.begin(), all.end());
    std::sort(steps.begin(), steps.end());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());

    std::vector<double> times;
    std::size_t step = 0;
    for (const double time : all)
    {
        while (step < steps.size() && steps[step] < time)
            ++step;
        const bool isStep = step < steps.size() && steps[step] == time;
        if (!times.empty() &&
            (time == times.back() || (!isStep && time < clip.duration && time < times.back() + nearest)))
            continue;
        if (const double before = std::nextafter(time, 0.0); isStep && time > 0.0 && before > times.back())
            times.push_back(before);
        times.push_back(time);
    }
    return times;
}

/// Puts times that bendTimes() set just before a step on the step.
inline void closeSteps(Curve& curve)
{
    for (std::size_t i = 0; i + 1 < curve.size(); ++i)
        if (curve[i].time == std::nextafter(curve[i + 1].time, 0.0))
            curve[i].time = curve[i + 1].time;
}

/// Reads a band's amplitude and frequency at times that only move forward.
class BandReader
{
public:
    explicit BandReader(const Band& band) noexcept
        : amplitude(band.amplitude),
          pitch(band.pitch),
          centre(portable::log2(std::max(band.centreFrequency, 1.0))),
          hasPitch(!band.pitch.empty())
    {
    }
    void readAt(double time) noexcept
    {
        const double a = amplitude.at(time);
        power = a * a;
        if (hasPitch)
            octave = portable::log2(std::max(pitch.at(time), 1.0));
        else
            octave = centre;
    }
    double power = 0.0;
    double octave = 0.0; ///< log2 of Hz

private:
    CurveReader amplitude, pitch;
    double centre;
    bool hasPitch;
};

/// Selects the band that one voice follows, time after time.
class FollowedBand
{
public:
    static constexpr auto none = static_cast<std::size_t>(-1);

    /// `lowest` and `highest` in Hz: a band outside counts 20 dB less per octave, as it cannot be played where it is.
    FollowedBand(double lowest, double highest) noexcept
        : low(portable::log2(std::max(lowest, 1.0))), high(portable::log2(std::max(highest, 1.0)))
    {
    }

    /// Returns the strongest of `bands` (as read last), `none` before any sounds. Bands less than a sixth of an octave
    /// apart count together, because they share the content between them. A new band must be 1 dB stronger, the just
    /// noticeable difference, so that bands of equal strength do not alternate.
    std::size_t of(const std::vector<BandReader>& bands) noexcept
    {
        constexpr double together = 1.0 / 6.0, oneDecibel = 1.2589;
        double best = band == none ? 0.0 : oneDecibel * strength(bands, bands[band], together);
        for (std::size_t i = 0; i < bands.size(); ++i)
            if (const double found = strength(bands, bands[i], together); found > best)
            {
                best = found;
                band = i;
            }
        return band;
    }

private:
    [[nodiscard]] double strength(const std::vector<BandReader>& bands, const BandReader& one,
                                  double together) const noexcept
    {
        double power = 0.0;
        for (const BandReader& other : bands)
            power += std::abs(other.octave - one.octave) < together ? other.power : 0.0;
        const double outside = std::max({0.0, low - one.octave, one.octave - high});
        return outside > 0.0 ? power * portable::exp10(-2.0 * outside) : power;
    }

    double low, high; // octaves
    std::size_t band = none;
};
} // namespace detail

/// The one voice that comes nearest to a valid clip:
///
/// - its amplitude is the clip's total envelope, which the sum of the bands is levelled to, or where there is none the
///   root of the summed powers of bands and noise;
/// - its frequency is that of the strongest band (see detail::FollowedBand), with a step where another one becomes it;
///   where nothing sounds, the one before holds. Bands outside `lowest` to `highest` Hz, where the voice is played and
///   felt, count less. A clip without bands has the frequency of its centroid;
/// - its events are the clip's, as strong as what the envelope around them does not reach by itself, which may be
///   nothing: they are played on top of it.
///
/// A clip that is one voice already keeps its points. Chosen over the mean of the bands' frequencies by power, which
/// lies between two partials where the sound has nothing (over thirty recordings as .haptic 0.8 dB more of LSD, 1.8
/// points less of HTS), and over merging bands in pairs (mergeVoices()), whose result is that mean in more steps.
/// O(points x bands^2).
[[nodiscard]] inline SingleVoice singleVoiceOf(const Clip& clip, double lowest = 20.0, double highest = 300.0)
{
    SingleVoice voice;
    voice.duration = clip.duration;
    voice.events = clip.transients;
    if (isSingleVoice(clip) && !clip.bands.empty())
    {
        const Band& band = clip.bands.front();
        voice.amplitude = detail::overWholeTime(band.amplitude, clip.duration);
        voice.frequency = detail::overWholeTime(
            band.pitch.empty() && band.centreFrequency > 0.0 ? Curve{{0.0, band.centreFrequency}} : band.pitch,
            clip.duration);
        return voice;
    }

    if (!clip.envelope.empty())
        for (Transient& event : voice.events)
            event.amplitude = pulseLevel(clip.envelope, event);
    std::vector<detail::BandReader> bands(clip.bands.begin(), clip.bands.end());
    std::vector<CurveReader> noise;
    for (const NoiseBand& band : clip.noise)
        noise.emplace_back(band.amplitude);
    CurveReader envelope(clip.envelope);
    CurveReader centroid(clip.centroid);
    constexpr double third = 1.0 / 3.0; // of an octave
    detail::FollowedBand choice(lowest, highest);
    std::size_t followed = detail::FollowedBand::none;
    double octave = -1.0;
    for (const double time : detail::bendTimes(clip))
    {
        double power = 0.0;
        for (detail::BandReader& band : bands)
        {
            band.readAt(time);
            power += band.power;
        }
        if (power > 0.0)
        {
            const std::size_t before = followed;
            followed = choice.of(bands);
            if (before != followed && !voice.frequency.empty() &&
                voice.frequency.back().time < std::nextafter(time, 0.0))
                voice.frequency.push_back({time, portable::exp2(bands[before].octave)});
            octave = bands[followed].octave;
        }
        double away = 0.0;
        for (const detail::BandReader& band : bands)
            away += std::abs(band.octave - octave) > third ? band.power : 0.0;
        double residual = 0.0;
        for (CurveReader& band : noise)
        {
            const double rms = band.at(time);
            residual += 2.0 * rms * rms;
        }
        const double level = clip.envelope.empty() ? std::sqrt(power + residual) : envelope.at(time);
        voice.amplitude.push_back({time, level});
        if (bands.size() > 1)
            voice.displaced.push_back({time, power > 0.0 ? level * std::sqrt(away / (power + residual)) : 0.0});
        if (octave >= 0.0)
            voice.frequency.push_back({time, portable::exp2(octave)});
        else if (bands.empty() && !clip.centroid.empty())
            voice.frequency.push_back({time, std::max(centroid.at(time), 1.0)});
    }
    for (Curve* curve : {&voice.amplitude, &voice.frequency, &voice.displaced})
        detail::closeSteps(*curve);
    voice.frequency = detail::overWholeTime(std::move(voice.frequency), clip.duration);
    return voice;
}

} // namespace pacini
