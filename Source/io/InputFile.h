#pragma once

// Opening and reading of input files that may be missing, hostile or endless.

#include "io/FileHandle.h"

#include <cstddef>
#include <string>

namespace pacini
{

/// Opens `path` to read bytes. `-` is standard input. What comes through it or another pipe is taken in whole the first
/// time, at most 8 GB (tooLarge): it can be rewound and opened again, but is read in one place at a time. Missing,
/// unreadable and folders are an Error (code io).
[[nodiscard]] Result<FileHandle> openForReading(const std::filesystem::path& path);

/// The same for what can be rewound: devices are refused (io).
[[nodiscard]] Result<FileHandle> openRewindable(const std::filesystem::path& path);

/// All bytes of `path`. More than `maximumBytes` is an Error (tooLarge), found before that much memory is used, so
/// endless devices and pipes are safe too. Errors of opening as in openForReading.
[[nodiscard]] Result<std::string> readWholeFile(const std::filesystem::path& path, std::size_t maximumBytes);

} // namespace pacini
