#pragma once

// Lint checks of a scene: parts without effect, or with less effect than written. All of it is in this header, as in
// SoundEncoder.h.

#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/Scene.h>
#include <pacini/synthesis/SceneTimeline.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace pacini
{

struct SceneFinding
{
    std::string where;   ///< such as `plays[3]`
    std::string message; ///< for people
};

namespace detail
{
inline void checkClips(const Scene& scene, std::vector<SceneFinding>& found)
{
    std::vector<bool> played(scene.clips.size(), false);
    for (const ScenePlay& play : scene.plays)
        played[play.clip] = true;
    for (std::size_t i = 0; i < played.size(); ++i)
        if (!played[i])
            found.push_back({indexed("clips", i), "is never played"});
}

/// Whether a play has anything of a role, its texture included.
inline bool hasRole(const Scene& scene, const ScenePlay& play, Role role)
{
    if (!play.texture)
        return pacini::hasRole(scene.clips[play.clip], role);
    return role == Role::noise || (role == Role::tones && !scene.textures[*play.texture].tones.empty());
}

/// Whether a place is a role of a play: to mute one does something.
inline bool isRole(const std::string& where)
{
    return std::any_of(allRoles.begin(), allRoles.end(),
                       [&](Role role) { return where.ends_with(std::string(".") + nameOf(role)); });
}

inline void checkPlan(const Scene& scene, std::vector<SceneFinding>& found)
{
    const auto plan = compilePlan(scene);
    if (!plan)
    {
        found.push_back({plan.error().where, plan.error().message});
        return;
    }
    for (const LeftOut& item : plan->leftOut)
        if (!isRole(item.where))
            found.push_back(
                {item.where, fmt::format("is not played: it {}{}", item.reason,
                                         std::isfinite(item.error) ? fmt::format(" (costs {:.0f} dB)", item.error)
                                                                   : std::string())});
}

inline void checkEnds(const SceneTimeline& timeline, std::vector<SceneFinding>& found)
{
    constexpr double margin = 1e-6; // s
    for (const TimedPlay& timed : timeline.plays)
        if (std::isfinite(timed.wanted) && timed.end > timed.start && timed.wanted > timed.end + margin)
            found.push_back({indexed("plays", timed.play),
                             fmt::format("is cut off by the end of the scene, {:.3f} s before its own end",
                                         timed.wanted - timed.end)});
}

inline void checkChanges(const Scene& scene, const SceneTimeline& timeline, std::vector<SceneFinding>& found)
{
    for (std::size_t i = 0; i < scene.changes.size(); ++i)
    {
        const SceneChange& change = scene.changes[i];
        const TimedPlay& timed = timeline.plays[change.play];
        if (change.time >= timeline.duration)
            found.push_back({indexed("changes", i), "comes after the end of the scene"});
        else if (change.time >= timed.end)
            found.push_back({indexed("changes", i),
                             fmt::format("comes after plays[{}], which ends at {:.3f} s", change.play, timed.end)});
        else if (change.parameter == SceneParameter::pan && scene.actuators == 1)
            found.push_back({indexed("changes", i), "is a pan, but the scene has only one actuator"});
        else if (const auto role = roleOf(change.parameter); role && !hasRole(scene, scene.plays[change.play], *role))
            found.push_back({indexed("changes", i), fmt::format("is of {}, but the clip has none", nameOf(*role))});
        else if (const bool moves =
                     change.parameter == SceneParameter::speed || change.parameter == SceneParameter::force;
                 moves && !scene.plays[change.play].texture)
            found.push_back({indexed("changes", i), "is of a texture, but the play has none"});
    }
}

inline void checkTextures(const Scene& scene, std::vector<SceneFinding>& found)
{
    std::vector<bool> played(scene.textures.size(), false);
    for (std::size_t i = 0; i < scene.plays.size(); ++i)
    {
        const ScenePlay& play = scene.plays[i];
        if (play.texture)
        {
            played[*play.texture] = true;
            if (play.transposition != 0.0)
                found.push_back(
                    {indexed("plays", i) + ".transposition", "has no effect on a texture; change its speed"});
        }
        else if (play.speed != ScenePlay{}.speed || play.force != ScenePlay{}.force)
            found.push_back({indexed("plays", i), "has a speed or a force, but no texture"});
    }
    for (std::size_t i = 0; i < played.size(); ++i)
        if (!played[i])
            found.push_back({indexed("textures", i), "is never played"});
}

inline void checkRoles(const Scene& scene, std::vector<SceneFinding>& found)
{
    for (std::size_t i = 0; i < scene.plays.size(); ++i)
        for (const Role role : allRoles)
            if (roleLevel(scene.plays[i], role) != 0.0 && !hasRole(scene, scene.plays[i], role))
                found.push_back({indexed("plays", i) + "." + nameOf(role), "has no effect: the clip has none"});
}

inline void checkPans(const Scene& scene, std::vector<SceneFinding>& found)
{
    if (scene.actuators > 1)
        return;
    for (std::size_t i = 0; i < scene.plays.size(); ++i)
        if (scene.plays[i].pan != ScenePlay{}.pan)
            found.push_back({indexed("plays", i) + ".pan", "has no effect: the scene has only one actuator"});
}
} // namespace detail

/// Clips that are never played; plays and bands of them that compilePlan() leaves out; plays that the end of the scene
/// cuts; changes that come after their play or the scene; pans with one actuator. In this order. Errors of
/// compilePlan() are findings too.
[[nodiscard]] inline std::vector<SceneFinding> checkScene(const Scene& scene)
{
    std::vector<SceneFinding> found;
    if (scene.plays.empty())
        found.push_back({"plays", "is empty and plays nothing"});
    const SceneTimeline timeline = timelineOf(scene);
    detail::checkClips(scene, found);
    detail::checkPlan(scene, found);
    detail::checkEnds(timeline, found);
    detail::checkChanges(scene, timeline, found);
    detail::checkPans(scene, found);
    detail::checkTextures(scene, found);
    detail::checkRoles(scene, found);
    return found;
}

} // namespace pacini
