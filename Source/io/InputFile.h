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

/// Opens `path` to read bytes. `-` is standard input. What comes through it or another pipe is taken in whole the first
/// time, at most 8 GB (tooLarge): it can be rewound and opened again, but is read in one place at a time. Missing,
/// unreadable and folders are an Error (code io).
[[nodiscard]] Result<FileHandle> openForReading(const std::filesystem::path& path);

/// The same for what can be rewound: devices are refused (io).
[[nodiscard]] Result<FileHandle> openRewindable(const std::filesystem::path& path);

/// Checks the first bytes of a file; returns their error, if any.
using StartCheck = std::function<std::optional<Error>(std::string_view start)>;

/// All bytes of `path`, unless `check` says what is wrong with the first 1024. More than `maximumBytes` is an Error
/// (tooLarge), found before that much memory is used, so endless devices and pipes are safe too. Errors of opening as
/// in openForReading.
[[nodiscard]] Result<std::string> readWholeFile(const std::filesystem::path& path, std::size_t maximumBytes,
                                                const StartCheck& check = {});

} // namespace pacini
