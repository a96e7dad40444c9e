#pragma once

// Opening and reading of input files that may be missing, hostile or endless.

#include "io/FileHandle.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace pacini
{

/// Opens `path` to read bytes. `-` is standard input. Standard input and other pipes are read completely the first
/// time, at most 8 GB (tooLarge): they can be rewound and opened again, but read in one place at a time. Missing and
/// unreadable files and folders are an Error (code io).
[[nodiscard]] Result<FileHandle> openForReading(const std::filesystem::path& path);

/// The same for files that can be rewound: devices are refused (io).
[[nodiscard]] Result<FileHandle> openRewindable(const std::filesystem::path& path);

/// Checks the first bytes of a file; returns their error, if any.
using StartCheck = std::function<std::optional<Error>(std::string_view start)>;

/// Returns all bytes of `path`, unless `check` returns an error for the first 1024. More than `maximumBytes` is an
/// Error (tooLarge), detected before that much memory is used, so endless devices and pipes are safe too. Errors of
/// opening as in openForReading.
[[nodiscard]] Result<std::string> readWholeFile(const std::filesystem::path& path, std::size_t maximumBytes,
                                                const StartCheck& check = {});

} // namespace pacini
