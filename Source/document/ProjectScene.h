#pragma once

// Scene of a project as the engine plays it: parts become plays, curves become changes.

#include "document/Project.h"

#include <pacini/foundation/Result.h>
#include <pacini/synthesis/Scene.h>

#include <cstddef>
#include <vector>

namespace pacini
{

/// Checks values, not whether clips are there; errors (invalidArgument) name the place, such as `parts[2].pan`.
[[nodiscard]] Result<void> validate(const ProjectScene& scene);

/// A scene with the clips that it needs, and the part of the project's scene that each play is.
struct BuiltScene
{
    Scene scene;
    std::vector<std::size_t> parts; ///< index of the part, for each play
};

/// What `pacini render` plays of a project whose scene is valid: plays in order of their parts, without those whose
/// clips are gone. Curves are points in seconds of a part, from where its delay lets it begin; each becomes a change
/// that glides from the point before it, so that levels, pan and delay go in straight lines; pitches step.
[[nodiscard]] BuiltScene sceneOf(const Project& project);

} // namespace pacini
