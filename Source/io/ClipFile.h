#pragma once

// Reading and writing of clip files in any format, and reading of files that are clips or scenes.

#include "io/AtomicFile.h"
#include "io/formats/ClipFormat.h"

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
struct ReadClip
{
    Clip clip;
    const ClipFormat* format = nullptr; ///< never null
    std::vector<std::string> warnings;
    std::string bytes; ///< the files read: the clip, then its companion if it has one
};

/// Reads a clip; content and extension determine the format. Adds the events of a companion (see ClipFormat). Unknown
/// keys in Pacini's formats are warnings, or errors if `strict`. Errors: io as in readWholeFile, tooLarge beyond 512
/// MB, those of the format's reader, and invalidData for unknown formats and for scenes.
[[nodiscard]] Result<ReadClip> readClip(const std::filesystem::path& path, bool strict = false);

/// A clip or a scene and where it came from.
struct ClipOrScene
{
    std::variant<Clip, Scene> content;
    const ClipFormat* format = nullptr; ///< null for a scene
    std::vector<std::string> warnings;
    std::string bytes; ///< as in ReadClip; of a scene its own

    [[nodiscard]] std::string_view formatName() const noexcept { return format == nullptr ? "scene" : format->name; }
};

struct ClipReadParams
{
    std::filesystem::path clipFolder; ///< where the clip files of scenes are; empty: beside the scene
    bool strict = false;              ///< as in readClip()
};

/// Reads a clip or a scene: a scene if the file's "format" says so, else a clip of any format. The file is read once.
/// Errors: those of readClip() and readScene().
[[nodiscard]] Result<ClipOrScene> readClipOrScene(const std::filesystem::path& path, const ClipReadParams& params = {});

/// Whether a file that could not be read was meant to be a clip or a scene rather than a sound, by content and
/// extension.
[[nodiscard]] bool looksLikeClip(const std::filesystem::path& path);

/// Returns the one of Pacini's own formats that a file, even a damaged clip, starts with; null if it is neither or
/// unreadable.
[[nodiscard]] const ClipFormat* ownFormatOf(const std::filesystem::path& path);

/// The extensions of all files that readClip() can tell.
[[nodiscard]] std::vector<std::string> clipFileExtensions();

/// Writes a clip in one of Pacini's own formats, piece by piece, and returns the size of the file in bytes. Errors:
/// those of validate(), then nothing is written; io as in AtomicFile.
[[nodiscard]] Result<std::size_t> writeClip(const std::filesystem::path& path, Clip clip, const ClipFormat& format,
                                            Existing existing = Existing::replace);

/// Writes all files of an export whose main file is to be `main` and returns their paths; of the others none that holds
/// something else is replaced where `existing` is `keep`. Errors: as in AtomicFile, with the name of the file where it
/// is not the main one.
[[nodiscard]] Result<std::vector<std::filesystem::path>>
writeExport(const std::filesystem::path& main, const ExportedClip& exported, Existing existing = Existing::replace);

/// The path of one of the files of an export whose main file is `main`, which has no suffix.
[[nodiscard]] std::filesystem::path exportPath(const std::filesystem::path& main, std::string_view suffix);

/// Returns the existing file that `path` is the companion of; else empty.
[[nodiscard]] std::filesystem::path companionOf(const std::filesystem::path& path);

/// Returns the companion (see ClipFormat) beside `main` that does not belong to this export but would be read with it:
/// from an earlier export, or another program. It is not removed. Empty if there is none.
[[nodiscard]] std::filesystem::path strayCompanion(const std::filesystem::path& main, const ClipFormat& format,
                                                   const ExportedClip& exported);

/// Says so to people.
[[nodiscard]] std::string strayWarning(const std::filesystem::path& stray);

} // namespace pacini
