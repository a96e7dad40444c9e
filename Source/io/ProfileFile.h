#pragma once

// Reading and writing of actuator profile files.

#include "io/ProfileJson.h"

#include <cstddef>
#include <filesystem>

namespace pacini
{

/// Reads a profile. Errors: io as in readWholeFile, and those of readProfileJson(); an ACF file, known by its extension
/// `.acf`, must be converted first.
[[nodiscard]] Result<Profile> readProfile(const std::filesystem::path& path, ReadWarnings* warnings = nullptr);

/// Whether the file's content claims to be a profile, valid or not. False for unreadable files and other content than
/// JSON.
[[nodiscard]] bool isProfile(const std::filesystem::path& path);

/// Writes a profile and returns the size of the file in bytes. Errors: those of validate(), then nothing is written; io
/// as in AtomicFile.
[[nodiscard]] Result<std::size_t> writeProfile(const std::filesystem::path& path, const Profile& profile);

} // namespace pacini
