#pragma once

// Actuators of an engine with the same profile: adaptation of clips to them, and their plays.

#include <pacini/actuator/ActuatorFit.h>
#include <pacini/runtime/EngineParams.h>
#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/DelayTap.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace pacini
{

/// Actuators of one profile.
struct ActuatorKind
{
    std::vector<std::size_t> actuators; ///< their indices in the engine
    CompileParams compile;
    RenderPlan plan; ///< without plays: what fits them
    std::optional<ActuatorFit> fit;
    std::optional<Profile> wanted;       ///< the profile before it was fitted
    bool asRendered = false;             ///< see EngineParams
    bool filtersVoices = false;          ///< plays come filtered
    std::unique_ptr<ScenePlayer> player; ///< of the engine's scene, or of an empty one

    [[nodiscard]] const Profile* profile() const noexcept { return plan.profile ? &*plan.profile : nullptr; }
};

namespace detail
{
/// What of a plan is for some of its actuators.
inline RenderPlan planFor(RenderPlan plan, const std::vector<std::size_t>& actuators)
{
    if (actuators.size() == plan.actuators)
        return plan;
    plan.actuators = actuators.size();
    plan.row.places = actuators;
    for (PlannedPlay& play : plan.plays)
    {
        PlayTimeline& timeline = play.timeline;
        const auto pick = [&](std::vector<Curve>& curves)
        {
            std::vector<Curve> picked;
            for (const std::size_t a : actuators)
                if (a < curves.size())
                    picked.push_back(std::move(curves[a]));
            curves = std::move(picked);
        };
        pick(timeline.gains);
        pick(timeline.delays);
    }
    return plan;
}

/// The scene that an engine plays without one.
inline Scene emptyScene(const EngineParams& params)
{
    Scene scene;
    scene.actuators = static_cast<int>(params.actuators.size());
    scene.panLaw = params.panLaw;
    scene.panDelay = params.panDelay.value;
    return scene;
}
} // namespace detail

/// The kinds of actuators of an engine, which plays `scene` by itself if there is one. Errors: those of compilePlan().
/// [worker]
[[nodiscard]] inline Result<std::vector<ActuatorKind>> makeActuatorKinds(const EngineParams& params, const Scene* scene)
{
    std::vector<ActuatorKind> kinds;
    std::vector<const std::optional<Profile>*> profiles;
    for (std::size_t a = 0; a < params.actuators.size(); ++a)
    {
        const auto& profile = params.actuators[a].profile;
        const auto same = std::find_if(profiles.begin(), profiles.end(), [&](const auto* p) { return *p == profile; });
        const auto kind = static_cast<std::size_t>(same - profiles.begin());
        if (same == profiles.end())
        {
            profiles.push_back(&profile);
            kinds.emplace_back();
        }
        kinds[kind].actuators.push_back(a);
    }
    const Scene empty = detail::emptyScene(params);
    for (std::size_t k = 0; k < kinds.size(); ++k)
    {
        ActuatorKind& kind = kinds[k];
        const Profile* profile = *profiles[k] ? &**profiles[k] : nullptr;
        kind.compile.sampleRate = params.sampleRate;
        kind.compile.decoder = params.decoder;
        kind.compile.adaptation = params.adaptation;
        CompileParams whole = kind.compile;
        whole.leaveOut = false;
        auto plan = compilePlan(empty, profile, whole);
        if (!plan)
            return plan.error();
        kind.plan = detail::planFor(std::move(plan).value(), kind.actuators);
        if (profile != nullptr && profile->technology != Technology::pcm)
            kind.fit = fitActuator(*profile, {params.adaptation.maxBoost, params.adaptation.strength});
        if (profile != nullptr)
            kind.wanted = *profile;
        kind.asRendered = params.asRendered;
        kind.filtersVoices = params.asRendered && scene == nullptr && profile != nullptr && !kind.plan.motor &&
                             kind.actuators.size() == 1;
        RenderPlan played = kind.plan;
        if (scene != nullptr)
        {
            auto planned = compilePlan(*scene, profile, kind.compile);
            if (!planned)
                return planned.error();
            played = detail::planFor(std::move(planned).value(), kind.actuators);
        }
        ScenePlayerParams playing;
        playing.sampleRate = params.sampleRate;
        playing.protect = params.protect;
        playing.liveDelay = params.longestDelay;
        playing.takeLatencyOut = false;
        playing.filtered = kind.filtersVoices;
        kind.player = std::make_unique<ScenePlayer>(std::move(played), playing);
    }
    return kinds;
}

} // namespace pacini
