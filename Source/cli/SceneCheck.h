#pragma once

// Lint checks of a scene: what in it does nothing, or less than is written there.

#include <pacini/synthesis/Scene.h>

#include <string>
#include <vector>

namespace pacini::cli
{

struct SceneFinding
{
    std::string where;   ///< such as `plays[3]`
    std::string message; ///< for people
};

/// Clips that are never played; plays and bands of them that compilePlan() leaves out; plays that the end of the scene
/// cuts; changes that come after their play or the scene; pans with one actuator. In this order. Errors of
/// compilePlan() are findings too.
[[nodiscard]] std::vector<SceneFinding> checkScene(const Scene& scene);

} // namespace pacini::cli
