#pragma once

// Conversion job: one clip from one format to another.

#include "cli/Manifest.h"
#include "cli/Overwrite.h"
#include "io/ClipFile.h"

#include <filesystem>
#include <string>

namespace pacini::cli
{

struct ConvertSettings
{
    const ClipFormat* format = nullptr; ///< never null
    ExportParams params;
    int quantise = 0;             ///< bits of the values of a packed clip; 0: as the clip says
    std::string record;           ///< what of the settings the outputs depend on
    std::filesystem::path folder; ///< the outputs' names in the entry count from here
    bool force = false;
    bool dryRun = false; ///< write nothing
    bool strict = false; ///< see readClip()
};

/// Result of the conversion of one clip.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a json does not throw, which clang-tidy does not see.
struct ConvertResult
{
    ManifestEntry entry;
    std::vector<FormatLoss> losses; ///< all of them
    bool upToDate = false;          ///< nothing was done
};

/// Converts `input` to `output` and whatever further files the format needs. Does nothing when `before` says that the
/// same input with the same settings became these outputs, and they are still what was written then. Errors: those of
/// readClip, ClipFormat::write and writeExport; io when what is at an output is not to be replaced: neither the same
/// nor what `before` says was written.
[[nodiscard]] Result<ConvertResult> convertClip(const std::filesystem::path& input, const std::filesystem::path& output,
                                                Replaceable replaceable, const ConvertSettings& settings,
                                                const ManifestEntry* before);

} // namespace pacini::cli
