#pragma once

// Clips in files of any format, Pacini's own and others', and scenes of them.

#include "io/formats/ForeignFormat.h"

#include <pacini/synthesis/Scene.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pacini
{

/// A clip and where it came from.
struct AnyClip
{
    Clip clip;
    std::string format; ///< json, packed or the name of a ForeignFormat
    std::vector<std::string> warnings;
    std::string bytes; ///< what was read: the file, then its companion if it has one
};

/// Reads a clip; content and extension decide the format. The events of a companion (see ForeignFormat) are added to
/// it. Keys of Pacini's formats that are not known are warnings, or errors if it is `strict`. Errors: as in readClip(),
/// those of the format's reader, and invalidData for a scene.
[[nodiscard]] Result<AnyClip> readAnyClip(const std::filesystem::path& path, bool strict = false);

/// A clip or a scene and where it came from.
struct ClipOrScene
{
    std::variant<Clip, Scene> content;
    std::string format; ///< scene, or as in AnyClip
    std::vector<std::string> warnings;
    std::string bytes; ///< as in AnyClip; of a scene its own
};

struct AnyReadParams
{
    std::filesystem::path clipFolder; ///< where the clip files of scenes are; empty: beside the scene
    bool strict = false;              ///< as in readAnyClip()
};

/// Reads what plays: a scene when the file's "format" says so, else a clip of any format. The file is read once.
/// Errors: those of readAnyClip() and readScene().
[[nodiscard]] Result<ClipOrScene> readClipOrScene(const std::filesystem::path& path, const AnyReadParams& params = {});

/// Whether a file that could not be read was meant to be a clip or a scene rather than a sound, by content and
/// extension.
[[nodiscard]] bool looksLikeClip(const std::filesystem::path& path);

/// The path of one of the files of an export whose main file is `main`.
[[nodiscard]] std::filesystem::path exportPath(const std::filesystem::path& main, std::string_view suffix);

/// The file that `path` is the companion of, if that is there; else empty.
[[nodiscard]] std::filesystem::path companionOf(const std::filesystem::path& path);

/// The extensions of all files that readAnyClip() can tell.
[[nodiscard]] std::vector<std::string> anyClipExtensions();

} // namespace pacini
