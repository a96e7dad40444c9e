#pragma once

// Scene compiler: Scene -> RenderPlan.

#include <pacini/actuator/ActuatorFit.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Portable.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/ClipAdaptation.h>
#include <pacini/synthesis/CompileParams.h>
#include <pacini/synthesis/Culling.h>
#include <pacini/synthesis/DecoderChoice.h>
#include <pacini/synthesis/LimitedError.h>
#include <pacini/synthesis/LoopUnroll.h>
#include <pacini/synthesis/PlayEnergy.h>
#include <pacini/synthesis/RenderPlan.h>
#include <pacini/synthesis/Scene.h>
#include <pacini/synthesis/VoiceLimit.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

namespace detail
{
/// Returns the length of a play with its changes, s; `duration` is that of the clip.
inline double playLength(const ScenePlay& play, const PlayTimeline& timeline, double duration)
{
    return makeClock(play.stretch, timeline).frameOf(duration);
}

/// The longest that a play is late, s.
inline double longestDelay(const PlayTimeline& timeline)
{
    double longest = 0.0;
    for (const Breakpoint& point : timeline.delay)
        longest = std::max(longest, point.value);
    return longest;
}

/// Takes the voices that an actuator does not have from the plays that need them least, and says so. Returns the energy
/// that is lost by it.
inline double limitVoices(RenderPlan& plan, const Scene& scene, const Profile& profile,
                          std::vector<PlayEnergy>& energies, const BiquadCascadeCoefficients& outputFilter)
{
    std::vector<VoiceClaim> claims;
    for (std::size_t i = 0; i < plan.plays.size(); ++i)
    {
        const PlannedPlay& planned = plan.plays[i];
        const ScenePlay& play = scene.plays[planned.play];
        const double length = playLength(play, planned.timeline, planned.clip.duration);
        const double end = std::min(planned.start + length, plan.duration);
        const std::size_t voices = planned.decoder.leftOut[Role::tones] ? 0 : planned.clip.bands.size();
        claims.push_back({planned.start, std::max(end, planned.start), voices, play.priority,
                          energies[i].most / std::max(end - planned.start, 1e-3)});
    }
    const auto losses = voiceLosses(claims, static_cast<std::size_t>(profile.polyphony));
    double lostEnergy = 0.0;
    for (std::size_t i = 0; i < losses.size(); ++i)
    {
        if (losses[i].empty())
            continue;
        PlannedPlay& planned = plan.plays[i];
        for (Curve& gain : planned.timeline.gains)
            gain = withoutVoice(gain, losses[i]);
        planned.timeline.level = withoutVoice(planned.timeline.level, losses[i]);
        const double before = energies[i].most;
        energies[i] =
            playEnergy(planned.clip, planned.decoder, planned.timeline, planned.start, plan.duration, outputFilter);
        lostEnergy += std::max(before - energies[i].most, 0.0);
        double lost = 0.0;
        for (const VoiceLoss& loss : losses[i])
            lost += loss.to - loss.from;
        plan.adaptations.push_back(
            {indexed("plays", planned.play), "has no voice for " + std::to_string(std::lround(1000.0 * lost)) +
                                                 " ms: plays with higher priority or level use them"});
    }
    return lostEnergy;
}

inline constexpr std::size_t maxUnrolledPoints = 20'000'000;

/// Changes energies to those behind the limiter of the actuator, if it can act; a motor has none. Returns the error of
/// a small change of the whole scene there, in energies of that change.
inline double limitEnergies(const RenderPlan& plan, std::vector<PlayEnergy>& energies, const Profile* profile)
{
    if (plan.motor)
        return 1.0;
    const LimitedScene limited(plan, energies, limiterModel(profile));
    if (!limited.limits())
        return 1.0;
    for (std::size_t i = 0; i < energies.size(); ++i)
        limited.limit(plan.plays[i], plan.duration, energies[i]);
    return LimitedScene::wholeScene;
}

/// Sets the playback of events by the clip's method, the user and the actuator; `range` is the range that the actuator
/// plays.
inline void fitPulses(DecoderParams& params, const Profile& profile, const ActuatorRange& range,
                      const DecoderChoice& choice)
{
    params.pulses.lowest = std::max(range.lowFrequency, profile.range.lowFrequency);
    params.pulses.highest = std::min(range.highFrequency, profile.range.highFrequency);
    if (choice.pulseShape || profile.transient.shape == TransientShape::adaptive)
        return;
    params.pulses.shape = profile.transient.shape;
    params.pulses.frequency = profile.transient.frequency;
    params.pulses.cycles = profile.transient.cycles;
}

/// Adapts the clips of a scene to the plan's actuator and records the changes.
inline std::vector<AdaptedClip> adaptClips(RenderPlan& plan, const std::vector<Clip>& clips,
                                           const AdaptationParams& params)
{
    std::vector<AdaptedClip> adapted;
    for (std::size_t i = 0; i < clips.size(); ++i)
    {
        adapted.push_back(adaptClip(clips[i], *plan.profile, params));
        for (std::string& what : adapted.back().changes)
            plan.adaptations.push_back({indexed("clips", i), std::move(what)});
    }
    return adapted;
}

/// Content of a scene that its actuator cannot play.
class Unplayable
{
public:
    /// What a play loses; `reason` in plain words.
    void add(const std::string& where, std::string reason, double energy)
    {
        items.push_back({where, std::move(reason), energy, true});
        lost += energy;
    }

    /// What is lost without an item of its own.
    void add(double energy) { lost += energy; }

    /// Lists the items in a plan, by the energy of all that was to be played.
    void list(RenderPlan& plan, double whole) &&
    {
        for (LeftOut& item : items)
        {
            item.error = errorInDecibels(item.error, whole);
            plan.leftOut.push_back(std::move(item));
        }
    }

    /// Of all, (drive^2) s.
    [[nodiscard]] double energy() const noexcept { return lost; }

private:
    std::vector<LeftOut> items; // with their energies
    double lost = 0.0;
};

/// Flattens the actuator's resonance where that helps, as far as its strength allows, and notes it.
inline void flatten(RenderPlan& plan, const ActuatorFit& fit)
{
    plan.flattening = fit.flattening;
    plan.profile->equalizer = fit.equalizer;
    if (plan.flattening)
        plan.adaptations.push_back(
            {"profile", "its resonance at " + std::to_string(std::lround(plan.flattening->actuator.frequency)) +
                            " Hz is flattened down to " +
                            std::to_string(std::lround(plan.flattening->target.frequency)) + " Hz"});
}

/// The timelines of all plays, and the plan's duration: a scene without one lasts until the last play ends.
inline std::vector<PlayTimeline> planTimelines(RenderPlan& plan, const Scene& scene)
{
    std::vector<std::vector<SceneChange>> changesOf(scene.plays.size());
    for (const SceneChange& change : scene.changes)
        changesOf[change.play].push_back(change);
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
            plan.duration = std::max(plan.duration,
                                     play.start + playLength(play, timelines[i], content) + longestDelay(timelines[i]));
        }
    }
    return timelines;
}

/// Why nothing of a play of `clip` can be heard, in plain words; empty when something may be.
inline std::string whyUnheard(const Clip& clip, const ScenePlay& play, const PlayTimeline& timeline, double duration)
{
    if (play.start >= duration)
        return "starts after the end of the scene";
    const bool muted = std::all_of(
        timeline.gains.begin(), timeline.gains.end(),
        [](const Curve& curve)
        { return std::all_of(curve.begin(), curve.end(), [](const Breakpoint& p) { return p.value == 0.0; }); });
    const bool roles = hasRoleLevels(timeline) &&
                       std::all_of(allRoles.begin(), allRoles.end(),
                                   [&](Role role) { return !hasRole(clip, role) || isMuted(timeline, role); });
    return muted || roles ? "is muted" : "";
}

/// Sets separate levels of tones and noise. Roles that are silent throughout are left out and recorded.
inline void planRoles(RenderPlan& plan, const Clip& clip, const PlayTimeline& timeline, const std::string& where,
                      bool leaveOut, DecoderParams& decoder)
{
    decoder.apart = hasRoleLevels(timeline);
    for (const Role role : allRoles)
        if (leaveOut && isMuted(timeline, role) && hasRole(clip, role))
        {
            decoder.leftOut[role] = true;
            plan.leftOut.push_back({where + "." + nameOf(role), "is muted", -std::numeric_limits<double>::infinity()});
        }
}

/// Returns the number of passes of a looping play until the scene ends.
inline double passesOf(const ScenePlay& play, const PlayTimeline& timeline, double duration)
{
    double fastest = play.stretch;
    for (const DecoderChange& change : timeline.changes)
        fastest = std::min(fastest, change.stretch);
    const double fitting = std::ceil((duration - play.start) / (play.loop * fastest));
    return play.passes > 0 ? std::min(static_cast<double>(play.passes), fitting) : fitting;
}

/// The clip of a play, varied and with its loop unrolled. `points` are those of the plays before, which this one's are
/// added to. Errors: `plays[i].loop` (tooLarge).
inline Result<Clip> bakedClip(const Clip& clip, const ScenePlay& play, const PlayTimeline& timeline, double duration,
                              const std::string& where, std::size_t& points)
{
    Clip played;
    if (play.loop > 0.0)
    {
        const double passes = passesOf(play, timeline, duration);
        const double perPass = static_cast<double>(breakpointCount(clip) + clip.transients.size()) + 2.0;
        if (passes * perPass + static_cast<double>(points) > static_cast<double>(maxUnrolledPoints))
            return Error{
                ErrorCode::tooLarge, where + ".loop",
                "unrolls to more than 20 million breakpoints in the scene; make the loop longer, or use fewer passes"};
        played = unrollLoop(clip, play.loop, static_cast<std::size_t>(std::max(1.0, passes)), play.variation);
    }
    else
        played = vary(clip, play.variation);
    points += breakpointCount(played) + played.transients.size();
    return played;
}

/// Returns the decoder parameters of a play's clip; `fit`: adapted to the plan's actuator, or unchanged.
inline DecoderParams planDecoder(const RenderPlan& plan, const Clip& clip, const ScenePlay& play,
                                 const CompileParams& params, const std::optional<ActuatorFit>& fit)
{
    DecoderParams base;
    base.sampleRate = params.sampleRate;
    base.transposition = play.transposition;
    base.stretch = play.stretch;
    base.variation.seed = play.variation.seed; // of the noise; the bands have been varied
    const double resonance = plan.profile ? plan.profile->resonance.frequency : 67.0;
    DecoderParams decoder = decoderParamsFor(clip, base, params.decoder, resonance);
    if (fit)
    {
        fitPulses(decoder, *plan.profile, fit->range, params.decoder);
        decoder.gaps.ring = ringTime(*plan.profile, *fit) / play.stretch; // gaps are stretched with the clip
    }
    if (plan.motor)
        decoder.carriers = CarrierMode::none;
    // Without its highest bands a clip would get another inner rate, and with it other rounding.
    decoder.reach = highestFrequency(clip, decoder.carriers);
    return decoder;
}

/// A clip that is like a texture as a play has it: a band of noise with its level over time, and a band with that of
/// its tones. What it will carry is predicted of this.
inline Clip standIn(Clip clip, const ScenePlay& play, const PlayTimeline& timeline, const TextureTable& table)
{
    constexpr int pieces = 16; // of a way on which the speed or the force moves
    const PlayClock clock = makeClock(play.stretch, timeline);
    std::vector<double> times = bends(timeline.force, timeline.speed, pieces);
    for (const double time : bends(timeline.speed, timeline.force, pieces))
        times.push_back(time);
    times.push_back(play.start);
    times.push_back(play.start + clock.frameOf(clip.duration));
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    Curve noise, tones;
    double most = 0.0;
    for (const double time : times)
    {
        const double inClip = clock.clipAt(std::max(time - play.start, 0.0));
        if (time < play.start || inClip > clip.duration)
            continue;
        const auto level = [&](double (TextureTable::*of)(const TextureTable::Place&) const)
        {
            return [&, of](double t)
            {
                const double force = portable::pow(valueAt(timeline.force, t), table.levelByForce());
                return force * (table.*of)(TextureTable::placeOf(valueAt(timeline.speed, t)));
            };
        };
        for (const auto& [curve, value] :
             {std::pair(&noise, level(&TextureTable::level)), std::pair(&tones, level(&TextureTable::tonesLevel))})
        {
            Curve sides;
            appendSides(sides, time, value);
            for (const Breakpoint& side : sides)
                curve->push_back({inClip, side.value});
        }
        most = std::max(most, tones.back().value);
    }
    clip.noise.push_back({textureLow, table.highest(), std::move(noise)});
    if (most > 0.0)
    {
        for (Breakpoint& point : tones)
            point.value *= std::numbers::sqrt2;
        Band band;
        band.lowFrequency = textureLow;
        band.centreFrequency = std::sqrt(textureLow * table.highest());
        band.highFrequency = table.highest();
        band.amplitude = std::move(tones);
        clip.bands.push_back(std::move(band));
    }
    return clip;
}

/// The bands of noise of a play that its actuator cannot play. Errors: those of bakedClip().
inline Result<void> findLostNoise(const RenderPlan& plan, const std::vector<LostNoise>& lost, const Clip& clip,
                                  const ScenePlay& play, const PlayTimeline& timeline, const DecoderParams& decoder,
                                  const std::string& where, const BiquadCascadeCoefficients& outputFilter,
                                  std::size_t& points, Unplayable& unplayable)
{
    for (const LostNoise& noise : lost)
    {
        Clip alone;
        alone.duration = clip.duration;
        alone.noise = {noise.band};
        const auto played = bakedClip(alone, play, timeline, plan.duration, where, points);
        if (!played)
            return played.error();
        const double energy = playEnergy(*played, decoder, timeline, play.start, plan.duration, outputFilter).most;
        if (energy > 0.0)
            unplayable.add(where + indexed(".noise", noise.index), "is noise outside the actuator's range", energy);
    }
    return {};
}

/// Plans all plays that can be heard, from the clips as they are fitted to the actuator. Errors: those of
/// bakedClip().
inline Result<void> planPlays(RenderPlan& plan, const Scene& scene, const std::vector<AdaptedClip>& clips,
                              std::vector<PlayTimeline> timelines, const CompileParams& params,
                              const std::optional<ActuatorFit>& fit, const BiquadCascadeCoefficients& outputFilter,
                              Unplayable& unplayable)
{
    std::size_t points = 0;
    std::vector<std::shared_ptr<const TextureTable>> textures(scene.textures.size());
    for (std::size_t i = 0; i < scene.plays.size(); ++i)
    {
        const ScenePlay& play = scene.plays[i];
        const std::string where = indexed("plays", i);
        const Clip& clip = clips.empty() ? scene.clips[play.clip] : clips[play.clip].clip;
        if (params.leaveOut && !play.texture)
            if (std::string why = whyUnheard(clip, play, timelines[i], plan.duration); !why.empty())
            {
                plan.leftOut.push_back({where, std::move(why), -std::numeric_limits<double>::infinity()});
                continue;
            }
        auto played = bakedClip(clip, play, timelines[i], plan.duration, where, points);
        if (!played)
            return played.error();
        if (play.texture)
        {
            auto& table = textures[*play.texture];
            if (!table)
                table = std::make_shared<const TextureTable>(scene.textures[*play.texture], params.sampleRate);
            *played = standIn(std::move(*played), play, timelines[i], *table);
            if (params.leaveOut)
                if (std::string why = whyUnheard(*played, play, timelines[i], plan.duration); !why.empty())
                {
                    plan.leftOut.push_back({where, std::move(why), -std::numeric_limits<double>::infinity()});
                    continue;
                }
        }
        DecoderParams decoder = planDecoder(plan, *played, play, params, fit);
        if (play.texture && plan.motor)
        {
            const double energy =
                playEnergy(*played, decoder, timelines[i], play.start, plan.duration, outputFilter).most;
            unplayable.add(where, "is a texture, which a motor cannot follow", energy);
            continue;
        }
        if (!clips.empty())
            if (auto found = findLostNoise(plan, clips[play.clip].lost, clip, play, timelines[i], decoder, where,
                                           outputFilter, points, unplayable);
                !found)
                return found.error();
        planRoles(plan, *played, timelines[i], where, params.leaveOut, decoder);
        plan.plays.push_back({i, std::move(*played), play.start, decoder, std::move(timelines[i]),
                              play.texture ? textures[*play.texture] : nullptr,
                              play.variation.seed ^ 0xD1B54A32D192ED03u * i}); // textures of plays differ
    }
    return {};
}
} // namespace detail

/// Compiles the plan of a scene for an actuator (none: the plain drive signal). Leaves out parts with the smallest
/// errors first, until the sum of the errors reaches the tolerance: plays that are silent, too weak or after the end,
/// bands of other plays, flat sections of the equalizer. Errors: those of validate(); a rate that nothing plays at
/// (`sampleRate`, invalidArgument); loops that would unroll to more than 20 million breakpoints (`plays[i].loop`,
/// tooLarge). [worker]
[[nodiscard]] inline Result<RenderPlan> compilePlan(const Scene& scene, const Profile* profile = nullptr,
                                                    const CompileParams& params = {})
{
    if (!isPlayableRate(params.sampleRate))
        return Error{ErrorCode::invalidArgument, "sampleRate", "must be 2000 to 768000 Hz"};
    if (auto valid = validate(scene); !valid)
        return valid.error();
    if (profile != nullptr)
        if (auto valid = validate(*profile); !valid)
            return valid.error();

    RenderPlan plan;
    plan.actuators = static_cast<std::size_t>(scene.actuators);
    plan.row = wholeRow(plan.actuators, scene.panLaw, Seconds(scene.panDelay));
    if (profile != nullptr)
        plan.profile = *profile;
    const bool adapts = profile != nullptr && params.adapt && profile->technology != Technology::pcm;
    plan.motor = adapts && params.adaptation.voices && profile->technology == Technology::erm;
    std::vector<AdaptedClip> adapted;
    std::optional<ActuatorFit> fit;
    if (adapts)
    {
        fit = fitActuator(*profile, {params.adaptation.maxBoost, params.adaptation.strength});
        adapted = detail::adaptClips(plan, scene.clips, params.adaptation);
    }
    if (adapts && !plan.motor)
        detail::flatten(plan, *fit);

    // Lengths first: endless loops need to know.
    auto timelines = detail::planTimelines(plan, scene);
    if (!(plan.duration <= limits::duration))
        return Error{ErrorCode::tooLarge, "duration", "would be longer than 24 hours"};
    const auto outputFilter = designOutputFilter(
        {plan.profile ? plan.profile->equalizer : EqualizerSections{}, plan.flattening}, params.sampleRate);
    detail::Unplayable unplayable;
    if (auto planned =
            detail::planPlays(plan, scene, adapted, std::move(timelines), params, fit, outputFilter, unplayable);
        !planned)
        return planned.error();

    std::vector<PlayEnergy> energies;
    for (const PlannedPlay& planned : plan.plays)
        energies.push_back(
            playEnergy(planned.clip, planned.decoder, planned.timeline, planned.start, plan.duration, outputFilter));
    if (adapts && params.adaptation.voices && profile->polyphony > 0 &&
        profile->polyphony < Profile::unlimitedPolyphony)
        unplayable.add(detail::limitVoices(plan, scene, *profile, energies, outputFilter));
    double wholeError = 1.0, whole = 0.0, lost = 0.0;
    if (params.leaveOut)
        wholeError = detail::limitEnergies(plan, energies, profile);
    for (const PlayEnergy& energy : energies)
        whole += energy.least;
    if (params.leaveOut)
    {
        lost = detail::leaveOutWeak(plan, scene, energies, whole, params.tolerance);
        if (plan.profile)
            lost += whole * wholeError *
                    detail::leaveOutFlatSections(plan, params.tolerance - Decibels::fromPower(wholeError).value,
                                                 params.sampleRate);
        for (PlannedPlay& planned : plan.plays)
            if (planned.texture && planned.clip.bands.empty())
                planned.decoder.leftOut[Role::tones] = true;
    }
    const double wanted = whole + unplayable.energy();
    plan.culledError = detail::errorInDecibels(lost, whole);
    plan.predictedError = detail::errorInDecibels(lost + unplayable.energy(), wanted);
    std::move(unplayable).list(plan, wanted);
    std::stable_sort(plan.plays.begin(), plan.plays.end(),
                     [](const PlannedPlay& a, const PlannedPlay& b) { return a.start < b.start; });
    return plan;
}

} // namespace pacini
