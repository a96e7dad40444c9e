#pragma once

// Overwrite policy: which existing files results may replace, and descriptions of the others.
//
// A file that the user named is replaced, unless it is an input or its source; windows ask first. Any other file is
// replaced only if Pacini made it from the same input and it is unchanged.

#include "io/AtomicFile.h"
#include "io/FileOrigin.h"
#include "io/formats/ClipFormat.h"

#include <pacini/foundation/Result.h>

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace pacini
{

/// Permission to replace an existing file by a result.
enum class Replaceable
{
    own,   ///< a file that Pacini made from the same input
    named, ///< the file that the user named, and was asked about where there is a window
    any,   ///< everything
};

/// Whether there is content at `path` that could be lost; a stream has none.
[[nodiscard]] bool isOccupied(const std::filesystem::path& path);

/// Returns how a file with that origin may be written to `output`. Errors: io, with the place and the reason: "exists,
/// and ...".
[[nodiscard]] Result<Existing> mayOverwrite(const std::filesystem::path& output, const FileOrigin& origin,
                                            Replaceable allowed);

/// The same for a file of a format without a place for its origin: the existing file must have the same `bytes`.
[[nodiscard]] Result<Existing> mayOverwrite(const std::filesystem::path& output, std::string_view bytes,
                                            Replaceable allowed);

/// The same for all files of an export whose main file is `main`; how that one may be written.
[[nodiscard]] Result<Existing> mayOverwrite(const std::filesystem::path& main, const ExportedClip& exported,
                                            Replaceable allowed);

/// Description of a file, for a question.
enum class FileKind
{
    sound,
    madeSound, ///< one that Pacini has made
    clip,
    scene,
    texture,
    profile,
    project,
    folder,
    other
};

/// Determines the kind by the content. [worker]
[[nodiscard]] FileKind kindOf(const std::filesystem::path& path);

struct StandingFile
{
    std::filesystem::path path;
    FileKind kind = FileKind::other;
};

/// Returns those of `results` that exist and could be lost. [worker]
[[nodiscard]] std::vector<StandingFile> standingAt(std::span<const std::filesystem::path> results);

/// The same for all ways of naming one file, whether it exists or not.
[[nodiscard]] std::filesystem::path sameFileKey(const std::filesystem::path& path);

/// Returns the real path of a file, with its own links resolved too, as far as possible.
[[nodiscard]] std::filesystem::path realPlace(const std::filesystem::path& path);

/// Whether both are one file, also through links of any kind.
[[nodiscard]] bool isSameFile(const std::filesystem::path& one, const std::filesystem::path& other);

} // namespace pacini
