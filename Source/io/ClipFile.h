#pragma once

// Clips in files, as JSON or packed.

#include "io/AtomicFile.h"
#include "io/ReadWarnings.h"

#include <pacini/clip/Clip.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace pacini
{

enum class ClipFormat
{
    json,   ///< text, see ClipJson.h
    packed, ///< quantised and coded, starts with the bytes "PACB"
};

/// Reads a clip; the content decides the format, not the name. Errors: io as in readWholeFile, tooLarge beyond 512 MB,
/// invalidData when it is neither format, and those of the format's reader.
[[nodiscard]] Result<Clip> readClip(const std::filesystem::path& path, ReadWarnings* warnings = nullptr);

/// The two halves of readClip(): the bytes of a file that may be a clip, and the clip that such bytes are.
[[nodiscard]] Result<std::string> readClipBytes(const std::filesystem::path& path);
[[nodiscard]] Result<Clip> clipOf(std::string_view bytes, ReadWarnings* warnings = nullptr);

/// The format that the file's content starts as; none when that is no clip's or the file cannot be read.
[[nodiscard]] std::optional<ClipFormat> clipFormatOf(const std::filesystem::path& path);

/// Writes a clip and returns the size of the file in bytes. Errors: those of validate(), then nothing is written; io as
/// in AtomicFile.
[[nodiscard]] Result<std::size_t> writeClip(const std::filesystem::path& path, Clip clip, ClipFormat format,
                                            Existing existing = Existing::replace);

} // namespace pacini
