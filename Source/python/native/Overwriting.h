#pragma once

// Overwrite policy of Python, for files that the caller named.

#include "io/Overwrite.h"

#include <pacini/clip/Clip.h>

#include <filesystem>
#include <functional>
#include <optional>

namespace pacini::python
{

/// The caller's `overwrite`: True replaces existing files, False keeps them, None replaces those of the same kind, and
/// sounds only if Pacini made them.
using Overwrite = std::optional<bool>;

/// Returns how a file of this kind may be written to `path`, which the caller named. Never replaces folders and the
/// recording that `clip` was made from. `isOwn` is called for a sound without a mark: it returns whether the sound is
/// an export of the same clip. Raises pacini.Error (io) if writing is not allowed. With the lock.
[[nodiscard]] Existing mayWrite(const std::filesystem::path& path, FileKind kind, Overwrite overwrite,
                                const Clip* clip = nullptr, const std::function<bool()>& isOwn = {});

} // namespace pacini::python
