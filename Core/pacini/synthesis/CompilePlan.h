#pragma once

// Scene -> RenderPlan.

#include <pacini/actuator/EqualizerPruning.h>
#include <pacini/synthesis/ClipAdaptation.h>
#include <pacini/synthesis/DecoderChoice.h>
#include <pacini/synthesis/LoopUnroll.h>
#include <pacini/synthesis/PlayEnergy.h>
#include <pacini/synthesis/RenderPlan.h>
#include <pacini/synthesis/Scene.h>
#include <pacini/synthesis/VoiceLimit.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace pacini
{

struct CompileParams
{
    double tolerance = -60.0;    ///< dB below the scene's energy that may be lost by leaving things out
    bool leaveOut = true;        ///< false plays everything, for comparison
    double sampleRate = 48000.0; ///< Hz, of the players to come; levels of the equaliser depend on it a little
    DecoderChoice decoder;
    bool adapt = true; ///< fit clips to the actuator; false plays them as they are
    AdaptationParams adaptation;
    bool operator==(const CompileParams&) const = default;
};

namespace detail
{
/// Adds up errors. Parts of one sound that start together add in amplitude, others in power; the sum is raised by 1.5
/// dB for what different sounds may have in common by chance.
class ErrorSum
{
public:
    using Key = std::tuple<std::size_t, double, double>; // clip, start, transposition

    [[nodiscard]] double with(const Key& key, double energy) const
    {
        const auto found = amplitudes.find(key);
        const double before = found == amplitudes.end() ? 0.0 : found->second;
        const double after = before + std::sqrt(energy);
        return margin * (power - before * before + after * after);
    }
    void add(const Key& key, double energy)
    {
        double& amplitude = amplitudes[key];
        power -= amplitude * amplitude;
        amplitude += std::sqrt(energy);
        power += amplitude * amplitude;
    }
    [[nodiscard]] double total() const { return margin * std::max(power, 0.0); }

private:
    static constexpr double margin = 1.41;
    std::map<Key, double> amplitudes;
    double power = 0.0;
};

inline double errorInDecibels(double energy, double whole)
{
    return energy > 0.0 && whole > 0.0 ? 10.0 * std::log10(energy / whole) : -std::numeric_limits<double>::infinity();
}

/// How long a play with its changes lasts, s; `duration` of the clip.
inline double playLength(const ScenePlay& play, const PlayTimeline& timeline, double duration)
{
    return makeClock(play.stretch, timeline).frameOf(duration);
}

/// Takes the voices that an actuator does not have from the plays that need them least, and says so.
inline void limitVoices(RenderPlan& plan, const Scene& scene, const Profile& profile, std::vector<PlayEnergy>& energies,
                        const BiquadCascadeCoefficients& outputFilter)
{
    std::vector<VoiceClaim> claims;
    for (std::size_t i = 0; i < plan.plays.size(); ++i)
    {
        const PlannedPlay& planned = plan.plays[i];
        const ScenePlay& play = scene.plays[planned.play];
        const double length = playLength(play, planned.timeline, planned.clip.duration);
        const double end = std::min(planned.start + length, plan.duration);
        claims.push_back({planned.start, std::max(end, planned.start), planned.clip.bands.size(), play.priority,
                          energies[i].most / std::max(end - planned.start, 1e-3)});
    }
    const auto losses = voiceLosses(claims, static_cast<std::size_t>(profile.polyphony));
    for (std::size_t i = 0; i < losses.size(); ++i)
    {
        if (losses[i].empty())
            continue;
        PlannedPlay& planned = plan.plays[i];
        for (Curve& gain : planned.timeline.gains)
            gain = withoutVoice(gain, losses[i]);
        energies[i] =
            playEnergy(planned.clip, planned.decoder, planned.timeline, planned.start, plan.duration, outputFilter);
        double lost = 0.0;
        for (const VoiceLoss& loss : losses[i])
            lost += loss.to - loss.from;
        plan.adaptations.push_back(
            {indexed("plays", planned.play), "has no voice for " + std::to_string(std::lround(1000.0 * lost)) +
                                                 " ms: plays of more priority or strength have them"});
    }
}

inline constexpr std::size_t mostUnrolledPoints = 20'000'000;

/// How an actuator's own events are played, after the clip's method and the user.
inline void fitPulses(DecoderParams& params, const Profile& profile, const DecoderChoice& choice)
{
    params.pulses.lowest = profile.range.lowFrequency;
    params.pulses.highest = profile.range.highFrequency;
    if (choice.pulseShape || profile.transient.shape == TransientShape::adaptive)
        return;
    params.pulses.shape = profile.transient.shape == TransientShape::square ? PulseShape::square : PulseShape::sine;
    params.pulses.frequency = profile.transient.frequency;
    params.pulses.cycles = profile.transient.cycles;
}
} // namespace detail

/// Works out what a scene needs on an actuator (none: the plain drive signal). What costs least is left out first,
/// until the sum of the errors reaches the tolerance: plays that are silent, too weak to matter or after the end, bands
/// of the others, sections of the equaliser that are flat. Errors: those of validate(); loops that would unroll to more
/// than 20 million breakpoints (`plays[i].loop`, tooLarge). [worker]
[[nodiscard]] inline Result<RenderPlan> compilePlan(const Scene& scene, const Profile* profile = nullptr,
                                                    const CompileParams& params = {})
{
    if (auto valid = validate(scene); !valid)
        return valid.error();
    if (profile != nullptr)
        if (auto valid = validate(*profile); !valid)
            return valid.error();

    RenderPlan plan;
    plan.actuators = static_cast<std::size_t>(scene.actuators);
    if (profile != nullptr)
        plan.profile = *profile;
    const bool adapts = profile != nullptr && params.adapt && profile->technology != Technology::pcm;
    plan.motor = adapts && params.adaptation.voices && profile->technology == Technology::erm;
    std::vector<Clip> adapted;
    if (adapts)
        for (std::size_t i = 0; i < scene.clips.size(); ++i)
        {
            AdaptedClip fitted = adaptClip(scene.clips[i], *profile, params.adaptation);
            adapted.push_back(std::move(fitted.clip));
            for (std::string& what : fitted.changes)
                plan.adaptations.push_back({detail::indexed("clips", i), std::move(what)});
        }
    const std::vector<Clip>& clips = adapts ? adapted : scene.clips;
    if (adapts && !plan.motor)
        plan.flattening = flatteningOf(*profile, Decibels(params.adaptation.maxBoost));
    if (plan.flattening)
        plan.adaptations.push_back(
            {"profile", "its resonance at " + std::to_string(std::lround(plan.flattening->actuator.frequency)) +
                            " Hz is flattened down to " +
                            std::to_string(std::lround(plan.flattening->target.frequency)) + " Hz"});
    const auto outputFilter = designOutputFilter(
        {profile != nullptr ? profile->equalizer : EqualizerSections{}, plan.flattening}, params.sampleRate);
    const double resonance = profile != nullptr ? profile->resonance.frequency : 67.0;

    std::vector<std::vector<SceneChange>> changesOf(scene.plays.size());
    for (const SceneChange& change : scene.changes)
        changesOf[change.play].push_back(change);

    // Lengths first: a scene without a duration lasts until the last play ends, and endless loops need to know.
    plan.duration = scene.duration;
    std::vector<PlayTimeline> timelines;
    timelines.reserve(scene.plays.size());
    for (std::size_t i = 0; i < scene.plays.size(); ++i)
    {
        const ScenePlay& play = scene.plays[i];
        timelines.push_back(makeTimeline(scene, i, changesOf[i]));
        if (scene.duration == 0.0)
        {
            const double content =
                play.loop > 0.0 ? play.loop * static_cast<double>(play.passes) : scene.clips[play.clip].duration;
            plan.duration = std::max(plan.duration, play.start + detail::playLength(play, timelines[i], content));
        }
    }
    if (!(plan.duration <= limits::duration))
        return Error{ErrorCode::tooLarge, "duration", "would be longer than 24 hours"};

    std::size_t points = 0;
    std::vector<PlayEnergy> energies;
    double whole = 0.0;
    for (std::size_t i = 0; i < scene.plays.size(); ++i)
    {
        const ScenePlay& play = scene.plays[i];
        const std::string where = detail::indexed("plays", i);
        const auto nothing = -std::numeric_limits<double>::infinity();
        if (params.leaveOut && play.start >= plan.duration)
        {
            plan.leftOut.push_back({where, "starts after the end of the scene", nothing});
            continue;
        }
        const auto& gains = timelines[i].gains;
        const bool muted = std::all_of(
            gains.begin(), gains.end(),
            [](const Curve& curve)
            { return std::all_of(curve.begin(), curve.end(), [](const Breakpoint& p) { return p.value == 0.0; }); });
        if (params.leaveOut && muted)
        {
            plan.leftOut.push_back({where, "is muted", nothing});
            continue;
        }
        PlannedPlay planned;
        planned.play = i;
        planned.start = play.start;
        planned.timeline = std::move(timelines[i]);
        const Clip& clip = clips[play.clip];
        if (play.loop > 0.0)
        {
            double fastest = play.stretch;
            for (const DecoderChange& change : planned.timeline.changes)
                fastest = std::min(fastest, change.stretch);
            const double fitting = std::ceil((plan.duration - play.start) / (play.loop * fastest));
            const double passes = play.passes > 0 ? std::min(static_cast<double>(play.passes), fitting) : fitting;
            const double perPass = static_cast<double>(breakpointCount(clip) + clip.transients.size()) + 2.0;
            if (passes * perPass + static_cast<double>(points) > static_cast<double>(detail::mostUnrolledPoints))
                return Error{ErrorCode::tooLarge, where + ".loop",
                             "unrolls to too many breakpoints (20 million are the most of a scene); make the loop "
                             "longer or its passes fewer"};
            planned.clip = unrollLoop(clip, play.loop, static_cast<std::size_t>(std::max(1.0, passes)), play.variation);
        }
        else
            planned.clip = vary(clip, play.variation);
        points += breakpointCount(planned.clip) + planned.clip.transients.size();

        DecoderParams base;
        base.sampleRate = params.sampleRate;
        base.transposition = play.transposition;
        base.stretch = play.stretch;
        base.variation.seed = play.variation.seed; // of the noise; the bands have been varied
        planned.decoder = decoderParamsFor(planned.clip, base, params.decoder, resonance);
        if (adapts)
            detail::fitPulses(planned.decoder, *profile, params.decoder);
        if (plan.motor)
            planned.decoder.carriers = CarrierMode::none;
        // Without its highest bands a clip would get another inner rate, and with it other rounding.
        planned.decoder.reach = highestFrequency(planned.clip, planned.decoder.carriers);
        energies.push_back(
            playEnergy(planned.clip, planned.decoder, planned.timeline, play.start, plan.duration, outputFilter));
        plan.plays.push_back(std::move(planned));
    }
    if (adapts && params.adaptation.voices && profile->polyphony > 0 &&
        profile->polyphony < Profile::unlimitedPolyphony)
        detail::limitVoices(plan, scene, *profile, energies, outputFilter);
    for (const PlayEnergy& energy : energies)
        whole += energy.least;

    struct Candidate
    {
        double energy;
        std::size_t planned;
        std::optional<std::size_t> band; // none: the whole play
    };
    std::vector<Candidate> candidates;
    if (params.leaveOut)
        for (std::size_t i = 0; i < plan.plays.size(); ++i)
        {
            candidates.push_back({energies[i].most, i, {}});
            if (plan.plays[i].decoder.carriers == CarrierMode::centroid)
                continue; // bands are placed by the mean of all centres: each counts
            for (std::size_t k = 0; k < energies[i].bands.size(); ++k)
                candidates.push_back({energies[i].bands[k], i, k});
        }
    // Whole plays first: they save most, and their bands would count twice.
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b)
                     { return a.band.has_value() != b.band.has_value() ? b.band.has_value() : a.energy < b.energy; });
    // An equaliser may take a quarter of the energy, which is half of the amplitude (see below).
    const double share = plan.profile && !plan.profile->equalizer.empty() ? 0.7 : 1.0;
    const double bearable = share * whole * std::pow(10.0, params.tolerance / 10.0);
    detail::ErrorSum error;
    std::vector<bool> playOut(plan.plays.size(), false);
    std::vector<std::vector<bool>> bandOut;
    for (const PlannedPlay& planned : plan.plays)
        bandOut.emplace_back(planned.clip.bands.size(), false);
    for (const Candidate& candidate : candidates)
    {
        if (playOut[candidate.planned])
            continue;
        const PlannedPlay& planned = plan.plays[candidate.planned];
        const ScenePlay& play = scene.plays[planned.play];
        const detail::ErrorSum::Key key{play.clip, play.start, play.transposition};
        if (candidate.energy > 0.0 && error.with(key, candidate.energy) > bearable)
            continue;
        error.add(key, candidate.energy);
        const std::string where = detail::indexed("plays", planned.play);
        const double cost = detail::errorInDecibels(candidate.energy, whole);
        if (candidate.band)
        {
            bandOut[candidate.planned][*candidate.band] = true;
            plan.leftOut.push_back({where + detail::indexed(".bands", *candidate.band),
                                    candidate.energy > 0.0 ? "is too weak to matter" : "is silent", cost});
        }
        else
        {
            playOut[candidate.planned] = true;
            plan.leftOut.push_back({where, candidate.energy > 0.0 ? "is too weak to matter" : "is silent", cost});
        }
    }
    double lost = error.total();
    if (plan.profile && params.leaveOut)
    {
        // A deviation of some dB everywhere is an error of that part of all the energy. Half the tolerance is for it.
        const double bearableGain = 1.0 + 0.5 * std::pow(10.0, params.tolerance / 20.0);
        PruningParams pruning;
        pruning.lowFrequency = Hertz(plan.profile->range.lowFrequency);
        pruning.highFrequency = Hertz(plan.profile->range.highFrequency);
        pruning.tolerance = Decibels(std::min(0.1, 20.0 * std::log10(bearableGain) / 4.0));
        const auto pruned = pruneEqualizer(plan.profile->equalizer, pruning, params.sampleRate);
        for (const DroppedSection& section : pruned.dropped)
            plan.leftOut.push_back({detail::indexed("equalizer", section.index), "is flat in the actuator's range",
                                    20.0 * std::log10(std::pow(10.0, section.deviation / 20.0) - 1.0 + 1e-30)});
        plan.profile->equalizer = pruned.kept;
        lost += whole * std::pow(std::pow(10.0, pruned.predictedError / 20.0) - 1.0, 2.0);
    }
    plan.predictedError = detail::errorInDecibels(lost, whole);

    std::vector<PlannedPlay> kept;
    for (std::size_t i = 0; i < plan.plays.size(); ++i)
    {
        if (playOut[i])
            continue;
        PlannedPlay& planned = plan.plays[i];
        std::vector<Band> bands;
        for (std::size_t k = 0; k < planned.clip.bands.size(); ++k)
            if (!bandOut[i][k])
                bands.push_back(std::move(planned.clip.bands[k]));
        planned.clip.bands = std::move(bands);
        kept.push_back(std::move(planned));
    }
    std::stable_sort(kept.begin(), kept.end(),
                     [](const PlannedPlay& a, const PlannedPlay& b) { return a.start < b.start; });
    plan.plays = std::move(kept);
    return plan;
}

} // namespace pacini
