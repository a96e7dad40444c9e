#pragma once

// Bundles of Pulsar (Software Mansion), version 1, with one preset.

#include "io/formats/ClipFormat.h"

#include <string_view>

namespace pacini
{

/// The schema text of a manifest.
inline constexpr std::string_view pulsarSchema = "pulsar.bundle/1";

[[nodiscard]] inline bool isPulsar(std::string_view bytes)
{
    return bytes.starts_with("PK\3\4") && bytes.find("manifest.json") != std::string_view::npos;
}

/// Reads a bundle of one preset. Its frequencies of 0 to 1 are those of sharpness. Warnings name sound and animation,
/// which are not kept, and values that are limited. Errors: invalidData with the place in the manifest or in the file
/// of the preset; unsupportedVersion for another schema; tooLarge for files beyond 64 MiB.
[[nodiscard]] Result<ImportedClip> readPulsar(std::string_view bytes);

/// Writes a bundle of one preset; the same clip gives the same bytes.
[[nodiscard]] Result<ExportedClip> writePulsar(const Clip& clip, const ExportParams& params);

} // namespace pacini
