#pragma once

// Description of a scene's content, as JSON and as text.

#include <pacini/synthesis/Scene.h>

#include <nlohmann/json.hpp>

#include <string>

namespace pacini::cli
{

/// {"kind": "scene", "duration": ..., "actuators": ..., "clips": [...], "plays": [...], "changes": 3} of a valid scene.
[[nodiscard]] nlohmann::ordered_json sceneReport(const Scene& scene);

/// The same in lines of text without the last line's end; of long lists the first entries and how many more there are.
[[nodiscard]] std::string sceneText(const std::string& file, const Scene& scene);

} // namespace pacini::cli
