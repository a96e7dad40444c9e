#pragma once

// Files at the places of results: those that the user is asked about, and those of the project, which nothing replaces.

#include "document/AudioReference.h"
#include "io/Overwrite.h"

#include <pacini/foundation/Result.h>

#include <filesystem>
#include <span>
#include <vector>

namespace pacini
{

class Document;

/// Files that a project needs.
struct ProjectFileSet
{
    std::vector<AudioReference> sounds;
    std::filesystem::path project; ///< empty: never saved
};

[[nodiscard]] ProjectFileSet filesOf(const Document& document);

/// What stands at the places of `results`. Errors: io, with the name of the file, where one of them is among `needed`.
/// [worker]
[[nodiscard]] Result<std::vector<StandingFile>> filesInTheWay(std::span<const std::filesystem::path> results,
                                                              const ProjectFileSet& needed);

} // namespace pacini
