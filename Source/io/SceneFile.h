#pragma once

// Scenes in files.

#include <pacini/synthesis/Scene.h>

#include <cstddef>
#include <filesystem>
#include <string_view>
#include <variant>

namespace pacini
{

/// Reads a scene; the clip files that it names are looked for in `clipFolder`, by default the scene's own. Errors: io
/// as in readWholeFile, tooLarge beyond 256 MB, and those of readSceneJson.
[[nodiscard]] Result<Scene> readScene(const std::filesystem::path& path, const std::filesystem::path& clipFolder = {});

/// Reads what `pacini render` plays: a scene when the file's "format" says so, else a clip. The file is read once.
/// Errors: those of readScene and readClip.
[[nodiscard]] Result<std::variant<Clip, Scene>> readClipOrScene(const std::filesystem::path& path,
                                                                const std::filesystem::path& clipFolder = {});

/// Whether the "format" of a JSON text is a scene's; reads no further than that.
[[nodiscard]] bool isSceneText(std::string_view text);

/// Writes a scene with its clips embedded and returns the size of the file in bytes. Errors: those of validate(), then
/// nothing is written; io as in AtomicFile.
[[nodiscard]] Result<std::size_t> writeScene(const std::filesystem::path& path, const Scene& scene);

} // namespace pacini
