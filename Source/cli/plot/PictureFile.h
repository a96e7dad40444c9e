#pragma once

// Picture files: PNG, SVG or PDF by the extension.

#include "cli/Overwrite.h"
#include "cli/plot/Canvas.h"

#include <cstddef>
#include <filesystem>
#include <functional>

namespace pacini::plot
{

enum class PictureFormat
{
    png,
    svg,
    pdf,
};

struct PictureSize
{
    int width = 1600; ///< pixels
    int height = 1000;
    bool operator==(const PictureSize&) const = default;
};

/// The format that the extension of `path` names (.png, .svg, .pdf in any case).
[[nodiscard]] std::optional<PictureFormat> pictureFormatOf(const std::filesystem::path& path);

/// Calls `draw`, then writes the picture to `path`, completely or not at all; returns its size in bytes. Errors:
/// invalidArgument for another extension, tooLarge, io as in AtomicFile and if an existing file must not be replaced.
[[nodiscard]] Result<std::size_t> writePicture(const std::filesystem::path& path, PictureSize size,
                                               const std::string& title, const std::function<void(Canvas&)>& draw,
                                               Replaceable replaceable = Replaceable::named);

} // namespace pacini::plot
