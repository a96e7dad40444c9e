#pragma once

// Timeline of a scene: start, end and level of each play.

#include <pacini/synthesis/PlayTimeline.h>
#include <pacini/synthesis/Scene.h>

#include <cstddef>
#include <vector>

namespace pacini::cli
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
[[nodiscard]] SceneTimeline timelineOf(const Scene& scene);

} // namespace pacini::cli
