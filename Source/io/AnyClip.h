#pragma once

// Clips in files of any format, Pacini's own and others'.

#include "io/formats/ForeignFormat.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
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
/// it. Errors: as in readClip(), and those of the format's reader.
[[nodiscard]] Result<AnyClip> readAnyClip(const std::filesystem::path& path);

/// The path of one of the files of an export whose main file is `main`.
[[nodiscard]] std::filesystem::path exportPath(const std::filesystem::path& main, std::string_view suffix);

/// The file that `path` is the companion of, if that is there; else empty.
[[nodiscard]] std::filesystem::path companionOf(const std::filesystem::path& path);

/// The extensions of all files that readAnyClip() can tell.
[[nodiscard]] std::vector<std::string> anyClipExtensions();

} // namespace pacini
