#pragma once

// Reading and writing of scene files.

#include "io/ReadWarnings.h"

#include <pacini/synthesis/Scene.h>

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace pacini
{

/// Reads a scene; the clip files that it names, of any format that readClip() reads, are looked for in `clipFolder`,
/// by default the scene's own. What the readers let pass goes to `warnings`, that of clip files with their names.
/// Errors: io as in readWholeFile, tooLarge beyond 256 MB, and those of readSceneJson.
[[nodiscard]] Result<Scene> readScene(const std::filesystem::path& path, const std::filesystem::path& clipFolder = {},
                                      ReadWarnings* warnings = nullptr);

/// The same of a scene's text, with clip files in `clipFolder`.
[[nodiscard]] Result<Scene> sceneOfText(std::string_view text, const std::filesystem::path& clipFolder,
                                        ReadWarnings* warnings = nullptr);

/// Whether the "format" of a JSON text is a scene's; reads no further than that.
[[nodiscard]] bool isSceneText(std::string_view text);

/// Writes a scene with its clips embedded and returns the size of the file in bytes. Errors: those of validate(), then
/// nothing is written; io as in AtomicFile.
[[nodiscard]] Result<std::size_t> writeScene(const std::filesystem::path& path, const Scene& scene);

} // namespace pacini
