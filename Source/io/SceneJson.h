#pragma once

// Scenes as JSON text: Resources/schema/pacini.scene.schema.json describes the format.

#include "io/ReadWarnings.h"

#include <pacini/synthesis/Scene.h>

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace pacini
{

inline constexpr std::string_view sceneFormatName = "pacini.scene";
inline constexpr int sceneFormatVersion = 1;

/// Longer texts are refused. A million changes fit, or clips of about five million points.
inline constexpr std::size_t largestSceneText = std::size_t(256) << 20;

namespace limits
{
inline constexpr std::size_t sceneClips = 10'000;
} // namespace limits

/// Reads the clip file that a scene names; errors without the file's name.
using ClipLoader = std::function<Result<Clip>(const std::string& file)>;

/// Reads the texture file that a scene names, likewise.
using TextureLoader = std::function<Result<Texture>(const std::string& file)>;

/// Reads a scene and checks it with validate(). Clips are file names, which `load` reads (each file once), or embedded;
/// a play names its clip by index, file or name, or a file that the scene does not list; textures likewise (without
/// `loadTexture` only embedded ones). A play of a texture without a clip gets a silent one of its `duration`. Required
/// are `format`, `version`, the `clip` or the `texture` of a play and all of a change but its `glide`; what is missing
/// keeps the default of Scene. Unknown keys are passed over with a warning each, if `warnings` are asked for; a key
/// given twice is an error. Errors carry the place, such as `plays[3].clip` or
/// `clips[2].clip.bands[0].amplitude[7].time`; those of `load` are at the reference, with the file's name in the
/// message. Codes: those of readClipJson and `load`.
[[nodiscard]] Result<Scene> readSceneJson(std::string_view text, const ClipLoader& load,
                                          ReadWarnings* warnings = nullptr, const TextureLoader& loadTexture = {});

/// The text of a scene for which validate() holds, with all members and its clips embedded, a play or a change on one
/// line. readSceneJson(writeSceneJson(scene)) == scene, except that bytes which are not UTF-8 become U+FFFD.
[[nodiscard]] std::string writeSceneJson(const Scene& scene);

} // namespace pacini
