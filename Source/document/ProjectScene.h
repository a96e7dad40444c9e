#pragma once

// Scene of a project and the scene that the engine plays: parts are plays, curves are changes.

#include "document/Project.h"

#include <pacini/actuator/Profile.h>
#include <pacini/foundation/Result.h>
#include <pacini/synthesis/Scene.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace pacini
{

/// Checks values, not whether clips are there; errors (invalidArgument) name the place, such as `parts[2].pan`.
[[nodiscard]] Result<void> validate(const ProjectScene& scene);

/// The value with which a part begins.
[[nodiscard]] double& valueOf(ScenePlay& play, SceneParameter parameter) noexcept;
[[nodiscard]] double valueOf(const ScenePlay& play, SceneParameter parameter) noexcept;

/// The value of a curve with at least one point; of levels in dB the gain goes in straight lines.
[[nodiscard]] double valueAt(SceneParameter parameter, const Curve& points, double time) noexcept;

/// s that a part lasts, from where its delay lets it begin; of one that is repeated without end, until the scene ends.
/// 0 where its clip is gone.
[[nodiscard]] double lengthOf(const Project& project, const ScenePart& part);
/// s: when the scene ends.
[[nodiscard]] double sceneEnd(const Project& project);

/// A scene with the clips that it needs, and the part of the project's scene that each play is.
struct BuiltScene
{
    Scene scene;
    std::vector<std::size_t> parts; ///< index of the part, for each play
};

/// What `pacini render` plays of a project whose scene is valid: plays in order of their parts, without those whose
/// clips are gone; a part with a texture is silent but for it, as long as its clip. Curves are points in seconds of a
/// part, from where its delay lets it begin; each becomes a change that glides from the point before it, so that
/// levels, pan and delay go in straight lines; pitches step.
[[nodiscard]] BuiltScene sceneOf(const Project& project);

/// The played parts of a scene, by its plan.
struct SceneForecast
{
    std::map<std::size_t, std::string> leftOut; ///< why a part is not played, by its index
    std::size_t bands = 0;                      ///< left out of parts that play
    double error = 0.0;                         ///< dB below the scene, of all that is left out
    double duration = 0.0;                      ///< s of the whole scene
};

/// On an actuator (null: the plain drive signal) that is played with `strength`, see fitActuator(). Errors: those of
/// compilePlan(). [any]
[[nodiscard]] Result<SceneForecast> forecast(const BuiltScene& built, const Profile* profile, double strength);

/// The other way round: a project's scene that sceneOf() makes a valid scene of again, whose clips are `clipIds` of the
/// project. Parts that overlap are on tracks of their own.
[[nodiscard]] ProjectScene projectSceneOf(const Scene& scene, const std::vector<int>& clipIds);

} // namespace pacini
