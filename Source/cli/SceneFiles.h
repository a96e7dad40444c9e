#pragma once

// Files of a long clip that is cut into scenes: a clip file for each, and a scene that plays them in time.

#include "io/Overwrite.h"
#include "io/formats/ClipFormat.h"

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini::cli
{

inline constexpr std::string_view sceneExtension = ".scene.json";

/// What is written, the scene last.
struct SceneFiles
{
    std::vector<std::pair<std::filesystem::path, std::string>> files; ///< with their bytes
    std::size_t scenes = 0;
};

/// The files of a clip whose scene is to be at `place`, `NAME.scene.json`: `NAME-0001.json` and so on beside it, none
/// shorter than `shortest` s unless the clip is. Errors: those of ClipFormat::write(), tooLarge for more than 10 000
/// scenes.
[[nodiscard]] Result<SceneFiles> sceneFiles(const Clip& clip, const std::filesystem::path& place, double shortest,
                                            const ClipFormat& format, const ExportParams& params);

/// Writes all of them, or none if one that stands there is another and may not be replaced; returns their bytes. Of
/// those of an earlier run, scenes beyond the last stay. Errors: io, with the place.
[[nodiscard]] Result<std::size_t> writeSceneFiles(const SceneFiles& files, Replaceable allowed);

} // namespace pacini::cli
