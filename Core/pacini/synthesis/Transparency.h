#pragma once

// Transparency: a clip that was designed on one actuator, changed so that it feels alike on another.

#include <pacini/actuator/ActuatorFit.h>
#include <pacini/actuator/BodyChain.h>
#include <pacini/actuator/MeasuredFelt.h>
#include <pacini/actuator/OutputFilter.h>
#include <pacini/actuator/Profile.h>
#include <pacini/clip/Clip.h>
#include <pacini/clip/edits/Lane.h>
#include <pacini/foundation/NumberText.h>
#include <pacini/foundation/Portable.h>
#include <pacini/foundation/Result.h>
#include <pacini/synthesis/AdaptationParams.h>
#include <pacini/synthesis/ClipAdaptation.h>
#include <pacini/synthesis/RenderPlan.h>
#include <pacini/synthesis/Scene.h>
#include <pacini/synthesis/VoiceMerge.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// Acceleration of the skin, m/s^2, that an amplitude of 1 of a clip becomes at a frequency: output filter, and
/// actuator and body of a profile or its measured response, as it is played with `params`.
class FeltResponse
{
public:
    /// The profile has a body or a measured acceleration and is no motor.
    FeltResponse(const Profile& profileOfActuator, const AdaptationParams& params)
        : profile(profileOfActuator),
          fit(fitActuator(profile, {params.maxBoost, params.strength})),
          filter(designOutputFilter({fit.equalizer, fit.flattening}, sampleRate))
    {
    }

    /// `f` in Hz is moved to the nearest end of the range that is played.
    [[nodiscard]] double at(double f) const noexcept
    {
        const Hertz played(std::clamp(f, fit.range.lowFrequency, fit.range.highFrequency));
        const double filtered = std::abs(filter.response(played, sampleRate));
        if (!profile.body) // the drive signal of an amplitude of 1 leaves room for the overdrive
            return filtered * Decibels(measuredLevelAt(profile.measurement->points, played.value)).gain() /
                   profile.drive.overdrive;
        return filtered * std::abs(bodyFrequencyResponse(*profile.body, profile.resonance, played));
    }

    /// Where events are strongest.
    [[nodiscard]] double atResonance() const noexcept
    {
        return at(profile.body ? loadedResonance(*profile.body, profile.resonance).frequency
                               : profile.resonance.frequency);
    }

    [[nodiscard]] const ActuatorRange& range() const noexcept { return fit.range; }

private:
    static constexpr double sampleRate = 48000.0; // Hz, far above any resonance

    const Profile& profile;
    ActuatorFit fit;
    BiquadCascadeCoefficients filter;
};

/// A clip for the actuator that plays it.
struct TransparentClip
{
    Clip clip;
    std::vector<std::string> changes; ///< what was done
    std::vector<std::string> lost;    ///< what cannot feel alike
};

namespace detail
{
/// Whether an actuator can be made transparent. Errors: invalidData at `technology` or `body`.
inline Result<void> checkTransparent(const Profile& profile)
{
    if (profile.technology == Technology::erm)
        return Error{ErrorCode::invalidData, "technology",
                     "is a motor, whose frequency follows its strength; choose an actuator that plays frequencies"};
    if (!profile.body && hasRelativeLevels(profile))
        return Error{ErrorCode::invalidData, "body",
                     "is missing, and the measured levels are relative, so that nobody knows how strongly it is felt; "
                     "measure with a calibrated sensor (--full-scale)"};
    if (!profile.body && !hasMeasuredAcceleration(profile))
        return Error{ErrorCode::invalidData, "body",
                     "is missing, so that nobody knows how strongly it is felt; choose a profile with a body model"};
    return {};
}

/// The amplitude of a band times `ratio(f)` at its frequency, at all points of amplitude and pitch and between these in
/// steps of a twelfth of an octave at most.
template <typename Ratio>
Curve weightedAmplitude(const Band& band, const Ratio& ratio)
{
    std::vector<double> times = joinedTimes(band.amplitude, band.pitch);
    for (std::size_t i = 1; i < band.pitch.size(); ++i)
    {
        const Breakpoint& a = band.pitch[i - 1];
        const Breakpoint& b = band.pitch[i];
        const double steps = std::min(120.0, std::ceil(12.0 * std::abs(portable::log2(b.value / a.value))));
        for (double k = 1.0; k < steps; ++k)
            times.push_back(a.time + (b.time - a.time) * k / steps);
    }
    std::sort(times.begin(), times.end());
    Curve weighted;
    CurveReader amplitude(band.amplitude), pitch(band.pitch);
    for (const double t : times)
        weighted.push_back({t, amplitude.at(t) * ratio(band.pitch.empty() ? band.centreFrequency : pitch.at(t))});
    return weighted;
}

/// The envelope of a clip whose bands were `before`, times what their sum of powers was weighted by; `factor` until one
/// sounds.
inline Curve weightedEnvelope(const Clip& clip, const std::vector<Band>& before, double factor)
{
    std::vector<double> times = joinedTimes(clip.envelope, {});
    for (const Band& band : clip.bands)
        for (const Breakpoint& point : band.amplitude)
            times.push_back(point.time);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    std::vector<CurveReader> old, now;
    for (std::size_t k = 0; k < before.size(); ++k)
    {
        old.emplace_back(before[k].amplitude);
        now.emplace_back(clip.bands[k].amplitude);
    }
    CurveReader envelope(clip.envelope);
    Curve levelled;
    for (const double t : times)
    {
        double power = 0.0, wanted = 0.0;
        for (std::size_t k = 0; k < before.size(); ++k)
        {
            const double x = old[k].at(t), y = now[k].at(t);
            power += x * x;
            wanted += y * y;
        }
        if (power > 0.0)
            factor = std::sqrt(wanted / power);
        levelled.push_back({t, envelope.at(t) * factor});
    }
    return levelled;
}
} // namespace detail

/// Makes a valid clip that was designed on `from` feel alike on `to`, each played with `params` (M. Weber, "A Framework
/// for Audio-Tactile Signal Translation", TU Berlin 2020, section 3.1.3: "vibrator transparency", there of signals;
/// here of curves): the clip is adapted to `from`, and what was felt there at each frequency and moment is asked of
/// `to`. The result is still to be adapted to `to`. Where that would be more than full drive, all of it is as much
/// weaker. Errors: invalidData at `technology` for motors and at `body` where the body is unknown, after `from.` or
/// `to.`.
[[nodiscard]] inline Result<TransparentClip> transparentClip(Clip clip, const Profile& from, const Profile& to,
                                                             const AdaptationParams& params = {})
{
    for (const auto& [profile, name] : {std::pair(&from, "from."), std::pair(&to, "to.")})
        if (auto able = detail::checkTransparent(*profile); !able)
            return Error{able.error().code, name + able.error().where, able.error().message};
    const FeltResponse there(from, params);
    const FeltResponse here(to, params);
    const auto ratio = [&](double f)
    {
        return there.at(f) / std::max(here.at(f), 1e-9);
    };
    TransparentClip result{adaptClip(std::move(clip), from, params).clip, {}, {}};
    Clip& made = result.clip;

    const std::vector<Band> before = made.bands;
    std::size_t outside = 0;
    for (Band& band : made.bands)
    {
        if (!band.amplitude.empty())
        {
            const double mean = detail::meanFrequency(band);
            outside += mean < here.range().lowFrequency || mean > here.range().highFrequency ? 1u : 0u;
        }
        band.amplitude = detail::weightedAmplitude(band, ratio);
    }
    if (!made.envelope.empty())
        made.envelope =
            detail::weightedEnvelope(made, before, here.atResonance() > 0.0 ? ratio(from.resonance.frequency) : 1.0);
    const double events = there.atResonance() / std::max(here.atResonance(), 1e-9);
    for (Transient& event : made.transients)
        event.amplitude *= events;
    for (NoiseBand& band : made.noise)
        for (Breakpoint& point : band.amplitude)
            point.value *= ratio(std::sqrt(std::max(band.lowFrequency, 1.0) * std::max(band.highFrequency, 1.0)));

    const double peak = detail::peakOf(made);
    if (peak > 1.0)
    {
        for (const Lane& lane : lanesOf(made))
            if (!isFrequency(lane.kind))
                for (Breakpoint& point : *curveOf(made, lane))
                    point.value /= peak;
        for (Transient& event : made.transients)
            event.amplitude /= peak;
        result.lost.push_back("is felt " + decimalText(Decibels::fromGain(peak).value, 1) +
                              " dB weaker than where it was designed: the actuator is at full drive");
    }
    if (outside > 0)
        result.lost.push_back(std::to_string(outside) + " of " + std::to_string(made.bands.size()) +
                              " bands lie outside of " + decimalText(here.range().lowFrequency, 0) + " to " +
                              decimalText(here.range().highFrequency, 0) +
                              " Hz, which the actuator plays, and are felt at other frequencies");
    if (to.polyphony > 0 && static_cast<std::size_t>(to.polyphony) < made.bands.size())
        result.lost.push_back(std::to_string(made.bands.size()) + " bands share " + std::to_string(to.polyphony) +
                              (to.polyphony == 1 ? " voice" : " voices"));
    result.changes.push_back("levels are those that are felt on " + from.name);
    return result;
}

/// The clips of a scene made transparent, see transparentClip().
struct TransparentScene
{
    Scene scene;
    std::vector<Adaptation> changes; ///< what was done
    std::vector<Adaptation> lost;    ///< what cannot feel alike
};

/// Makes all clips of a scene that was designed on `from` feel alike on `to`. Errors: those of transparentClip().
[[nodiscard]] inline Result<TransparentScene> transparentScene(Scene scene, const Profile& from, const Profile& to,
                                                               const AdaptationParams& params = {})
{
    TransparentScene result{std::move(scene), {}, {}};
    for (std::size_t i = 0; i < result.scene.clips.size(); ++i)
    {
        Clip& clip = result.scene.clips[i];
        auto made = transparentClip(std::move(clip), from, to, params);
        if (!made)
            return made.error();
        clip = std::move(made->clip);
        const std::string where = "clips[" + std::to_string(i) + "]";
        for (std::string& what : made->changes)
            result.changes.push_back({where, std::move(what)});
        for (std::string& what : made->lost)
            result.lost.push_back({where, std::move(what)});
    }
    return result;
}

} // namespace pacini
