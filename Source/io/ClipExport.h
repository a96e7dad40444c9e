#pragma once

// Clips into files of any format.

#include "io/AtomicFile.h"
#include "io/formats/ForeignFormat.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// A format that clips are written in: Pacini's two, or a foreign one.
struct ClipTarget
{
    std::string_view name;      ///< json, packed or the foreign format's
    std::string_view extension; ///< with dot
    const ForeignFormat* foreign = nullptr;
};

/// All targets, Pacini's first.
[[nodiscard]] const std::vector<ClipTarget>& clipTargets();

/// The target of this name, or the first of this extension (lower case, with dot); null when there is none.
[[nodiscard]] const ClipTarget* clipTargetNamed(std::string_view name);
[[nodiscard]] const ClipTarget* clipTargetOf(std::string_view extension);

/// The files that `clip` becomes: for Pacini's formats one, and no losses but what quantising a packed clip costs,
/// which is not counted. Errors: those of validate() and of the format's writer.
[[nodiscard]] Result<ExportedClip> exportClip(const Clip& clip, const ClipTarget& target, const ExportParams& params);

/// The file beside `main` that is no part of this export but would be read with it: a companion (see ForeignFormat)
/// that is left from an earlier one, or somebody else's. It stays where it is; empty when there is none.
[[nodiscard]] std::filesystem::path strayCompanion(const std::filesystem::path& main, const ClipTarget& target,
                                                   const ExportedClip& exported);

/// Says so to people.
[[nodiscard]] std::string strayWarning(const std::filesystem::path& stray);

/// One file as it was written.
struct WrittenFile
{
    std::filesystem::path path;
    std::size_t bytes = 0;
};

/// Writes all files of an export whose main file is to be `main`; `existing` is about that one. Errors: as in
/// AtomicFile, with the name of the file where it is not the main one.
[[nodiscard]] Result<std::vector<WrittenFile>>
writeExport(const std::filesystem::path& main, const ExportedClip& exported, Existing existing = Existing::replace);

} // namespace pacini
