#pragma once

// Adaptation of a clip to the abilities of an actuator.

#include <pacini/actuator/ActuatorFit.h>
#include <pacini/actuator/DynamicRangeMap.h>
#include <pacini/actuator/FrequencyMap.h>
#include <pacini/actuator/Profile.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/Portable.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/AdaptationParams.h>
#include <pacini/synthesis/VoiceMerge.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// A band of noise that an actuator cannot play.
struct LostNoise
{
    std::size_t index = 0; ///< in the clip as it was given
    NoiseBand band;        ///< with its adapted level
};

/// A clip made for an actuator.
struct AdaptedClip
{
    Clip clip;
    std::vector<std::string> changes = {}; ///< the changes, in plain words
    std::vector<LostNoise> lost = {};      ///< outside the actuator's range, no longer in the clip
};

namespace detail
{
/// The band's energy-weighted mean frequency in Hz.
inline double meanFrequency(const Band& band)
{
    double weighted = 0.0, sum = 0.0;
    CurveReader pitch(band.pitch);
    for (std::size_t i = 0; i < band.amplitude.size(); ++i)
    {
        const Breakpoint& point = band.amplitude[i];
        const double span = (i + 1 < band.amplitude.size() ? band.amplitude[i + 1].time : point.time) -
                            (i > 0 ? band.amplitude[i - 1].time : point.time);
        const double energy = point.value * point.value * std::max(span, 1e-3);
        const double f = band.pitch.empty() ? band.centreFrequency : pitch.at(point.time);
        weighted += energy * portable::log(std::max(f, 1.0));
        sum += energy;
    }
    return sum > 0.0 ? portable::exp(weighted / sum) : std::max(band.centreFrequency, 1.0);
}

/// Shifts one band by the ratio of its new mean to its old mean, so that its pitch keeps its shape, and clamps it to
/// the range.
inline bool moveBand(Band& band, const FrequencyMap& map, const ActuatorRange& range)
{
    const double mean = meanFrequency(band);
    const double ratio = map(mean) / mean;
    bool moved = false;
    const auto move = [&](double f)
    {
        const double to = std::clamp(f * ratio, range.lowFrequency, range.highFrequency);
        moved = moved || std::abs(to - f) > 1e-9 * f;
        return to;
    };
    band.centreFrequency = move(band.centreFrequency);
    band.lowFrequency = std::min(band.lowFrequency, band.centreFrequency);
    band.highFrequency = std::max(band.highFrequency, band.centreFrequency);
    for (Breakpoint& point : band.pitch)
        point.value = move(point.value);
    return moved;
}

/// Scales all amplitudes of a clip like the envelope at their time, by `map` (like its loudest band without an
/// envelope).
inline void mapLevels(Clip& clip, const DynamicRangeMap& map)
{
    const Curve envelope = clip.envelope;
    const auto gainAt = [&](double time, double own)
    {
        const double level = envelope.empty() ? own : valueAt(envelope, time);
        return level > 0.0 ? map(level) / level : 0.0;
    };
    for (Breakpoint& point : clip.envelope)
        point.value = map(point.value);
    for (Band& band : clip.bands)
        for (Breakpoint& point : band.amplitude)
            point.value *= gainAt(point.time, point.value);
    for (NoiseBand& band : clip.noise)
        for (Breakpoint& point : band.amplitude)
            point.value *= gainAt(point.time, point.value);
    for (Transient& event : clip.transients)
        event.amplitude = map(event.amplitude);
}

inline double peakOf(const Clip& clip)
{
    double peak = 0.0;
    for (const Breakpoint& point : clip.envelope)
        peak = std::max(peak, point.value);
    if (clip.envelope.empty())
        for (const Band& band : clip.bands)
            for (const Breakpoint& point : band.amplitude)
                peak = std::max(peak, point.value);
    for (const Transient& event : clip.transients)
        peak = std::max(peak, event.amplitude);
    return peak;
}

/// Returns the strength over time for a motor: the envelope (without one, that of bands and noise), plus a burst of
/// `burst` seconds for every event. Sampled every `step` seconds, because the resulting drive has no straight lines.
inline std::vector<double> wantedStrength(const Clip& clip, double step, double burst)
{
    std::vector<double> strength(static_cast<std::size_t>(std::ceil(clip.duration / step)) + 1, 0.0);
    CurveReader envelope(clip.envelope);
    std::vector<CurveReader> bands, noise;
    for (const Band& band : clip.bands)
        bands.emplace_back(band.amplitude);
    for (const NoiseBand& band : clip.noise)
        noise.emplace_back(band.amplitude);
    for (std::size_t n = 0; n < strength.size(); ++n)
    {
        const double t = step * static_cast<double>(n);
        if (!clip.envelope.empty())
            strength[n] = envelope.at(t);
        else
        {
            double power = 0.0;
            for (CurveReader& band : bands)
                power += std::pow(band.at(t), 2.0);
            for (CurveReader& band : noise)
                power += 2.0 * std::pow(band.at(t), 2.0); // of an RMS value, not of a peak
            strength[n] = std::sqrt(power);
        }
    }
    for (std::size_t i = 0; i < clip.transients.size(); ++i)
    {
        const Transient& event = clip.transients[i];
        double length = burst;
        if (i + 1 < clip.transients.size())
            length = std::min(length, 0.6 * (clip.transients[i + 1].time - event.time));
        const auto first = static_cast<std::size_t>(event.time / step);
        const auto last = first + std::max<std::size_t>(1, static_cast<std::size_t>(length / step));
        for (std::size_t n = first; n < std::min(last, strength.size()); ++n)
            strength[n] = std::max(strength[n], event.amplitude);
    }
    return strength;
}

/// Takes the bands of noise out of a clip that lie outside a range.
inline std::vector<LostNoise> takeNoiseOutside(Clip& clip, const ActuatorRange& range)
{
    std::vector<LostNoise> lost;
    std::vector<NoiseBand> kept;
    for (std::size_t k = 0; k < clip.noise.size(); ++k)
    {
        NoiseBand& band = clip.noise[k];
        if (band.highFrequency < range.lowFrequency || band.lowFrequency > range.highFrequency)
            lost.push_back({k, std::move(band)});
        else
            kept.push_back(std::move(band));
    }
    clip.noise = std::move(kept);
    return lost;
}

/// A curve through equally spaced samples without those that lie on a straight line (within `tolerance`).
inline Curve curveThrough(const std::vector<double>& samples, double step, double tolerance, double duration)
{
    Curve curve;
    for (std::size_t n = 0; n < samples.size(); ++n)
    {
        if (n > 0 && n + 1 < samples.size() &&
            std::abs(samples[n + 1] - 2.0 * samples[n] + samples[n - 1]) < tolerance &&
            std::abs(samples[n] - curve.back().value) < 0.02)
            continue;
        curve.push_back({std::min(step * static_cast<double>(n), duration), samples[n]});
    }
    return curve;
}
} // namespace detail

/// Adapts a valid clip to a valid profile:
///
/// - Frequencies outside the range are moved into it, each band as a whole (see FrequencyMap). Flattening extends the
///   range and strength narrows it (see fitActuator).
/// - Bands without a voice join their nearest neighbour with one (see mergeVoices).
/// - Amplitudes are compressed into the range of the actuator (see DynamicRangeMap).
/// - A motor gets its strength as the amplitude of one band, with events as bursts of its spin-up time; MotorDrive
///   turns it into voltage.
[[nodiscard]] inline AdaptedClip adaptClip(Clip clip, const Profile& profile, const AdaptationParams& params = {})
{
    AdaptedClip result{std::move(clip)};
    Clip& adapted = result.clip;
    if (profile.technology == Technology::pcm)
        return result;

    const bool becomesStrength = params.voices && profile.technology == Technology::erm;
    if (params.dynamicRange)
    {
        const Decibels felt(35.0); // that a sound's loudest part stands above what is just felt beside it
        DynamicRangeParams range;
        range.actuatorRange = Decibels(profile.range.dynamicRange);
        range.clipRange = felt;
        range.clipPeak = std::max(detail::peakOf(adapted), 1e-6);
        const DynamicRangeMap map(range);
        if (!map.isIdentity())
        {
            detail::mapLevels(adapted, map);
            result.changes.push_back("levels are compressed into " +
                                     std::to_string(static_cast<int>(std::lround(range.actuatorRange.value))) + " dB");
        }
    }

    if (params.frequencies && profile.polyphony > 0)
    {
        Profile reached = profile;
        reached.frequencyMapping = params.mapping.value_or(profile.frequencyMapping);
        const ActuatorFit fit = fitActuator(profile, {params.maxBoost, params.strength});
        reached.range = fit.range;
        const FrequencyMap map(reached);
        std::size_t moved = 0;
        for (Band& band : adapted.bands)
            if (detail::moveBand(band, map, reached.range))
                ++moved;
        if (!becomesStrength)
            result.lost = detail::takeNoiseOutside(adapted, reached.range);
        if (moved > 0)
            result.changes.push_back(std::to_string(moved) + " of " + std::to_string(adapted.bands.size()) +
                                     " bands are moved " +
                                     (fit.towardsResonance > 0.0 ? "towards the resonance" : "into the range"));
    }

    const auto voices = static_cast<std::size_t>(std::max(profile.polyphony, 1));
    if (params.voices && adapted.bands.size() > voices)
    {
        const auto before = adapted.bands.size();
        mergeVoices(adapted, voices);
        result.changes.push_back(std::to_string(before) + " bands share " + std::to_string(adapted.bands.size()) +
                                 (adapted.bands.size() == 1 ? " voice" : " voices"));
    }

    if (becomesStrength)
    {
        constexpr double step = 0.001; // s
        const double burst = std::max(0.012, profile.response.riseTime);
        const std::vector<double> strength = detail::wantedStrength(adapted, step, burst);
        if (!adapted.transients.empty())
            result.changes.push_back(adapted.transients.size() == 1
                                         ? std::string("1 event becomes a burst")
                                         : std::to_string(adapted.transients.size()) + " events become bursts");
        Band band;
        if (!adapted.bands.empty())
            band = std::move(adapted.bands.front());
        else
            band.lowFrequency = band.centreFrequency = band.highFrequency = profile.resonance.frequency;
        band.amplitude = detail::curveThrough(strength, step, 1e-4, adapted.duration);
        adapted.bands = {std::move(band)};
        adapted.envelope.clear();
        adapted.transients.clear();
        adapted.noise.clear();
    }
    return result;
}

} // namespace pacini
