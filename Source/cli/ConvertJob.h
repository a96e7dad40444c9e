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
    std::string record;           ///< the settings that affect the outputs
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

/// Converts `input` to `output` and any further files of the format. Does nothing if `before` records the same input,
/// settings and outputs, and these outputs are unchanged. Errors: those of readClip, ClipFormat::write and writeExport;
/// io if an existing output must not be replaced, because it is neither equal nor recorded in `before`.
[[nodiscard]] Result<ConvertResult> convertClip(const std::filesystem::path& input, const std::filesystem::path& output,
                                                Replaceable replaceable, const ConvertSettings& settings,
                                                const ManifestEntry* before);

} // namespace pacini::cli
