#pragma once

// Overwrite policy of Python, for files that the caller named.

#include "io/Overwrite.h"

#include <pacini/clip/Clip.h>

#include <filesystem>
#include <functional>
#include <optional>

namespace pacini::python
{

/// What a caller said of files that exist: True replaces them, False leaves them, None replaces those of the same kind,
/// and sounds only as Pacini made them.
using Overwrite = std::optional<bool>;

/// How a file of this kind may be written to `path`, which the caller named. The recording that `clip` was made from
/// and folders are never replaced. `isOwn` is asked about a sound without a mark: whether it is an export of the same
/// clip, of which nothing can be lost. Raises pacini.Error (io) where it may not. With the lock.
[[nodiscard]] Existing mayWrite(const std::filesystem::path& path, FileKind kind, Overwrite overwrite,
                                const Clip* clip = nullptr, const std::function<bool()>& isOwn = {});

} // namespace pacini::python
