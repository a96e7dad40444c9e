#pragma once

// Timeline of a scene: start, end and level of each play.

#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/PlayTimeline.h>
#include <pacini/synthesis/Scene.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace pacini
{

/// One play of a scene as it happens; times in s of the scene.
struct TimedPlay
{
    std::size_t play = 0; ///< index into the scene's plays
    double start = 0.0;
    double end = 0.0;    ///< at most that of the scene; at its start when it never sounds
    double wanted = 0.0; ///< where it would end if the scene went on; infinite for an endless loop
    std::size_t changes = 0;
    PlayTimeline timeline;
};

struct SceneTimeline
{
    double duration = 0.0;        ///< s of the scene
    std::vector<TimedPlay> plays; ///< in the scene's order
};

/// The timeline of a valid scene.
[[nodiscard]] inline SceneTimeline timelineOf(const Scene& scene)
{
    RenderPlan plan;
    auto timelines = detail::planTimelines(plan, scene);
    SceneTimeline result{plan.duration, {}};
    for (std::size_t i = 0; i < scene.plays.size(); ++i)
    {
        const ScenePlay& play = scene.plays[i];
        TimedPlay timed{i, play.start, play.start, std::numeric_limits<double>::infinity(), 0, std::move(timelines[i])};
        if (play.loop == 0.0 || play.passes > 0)
        {
            const double content =
                play.loop > 0.0 ? play.loop * static_cast<double>(play.passes) : scene.clips[play.clip].duration;
            timed.wanted = play.start + detail::playLength(play, timed.timeline, content);
        }
        timed.end = std::clamp(timed.wanted, play.start, std::max(play.start, plan.duration));
        result.plays.push_back(std::move(timed));
    }
    for (const SceneChange& change : scene.changes)
        ++result.plays[change.play].changes;
    return result;
}

} // namespace pacini
