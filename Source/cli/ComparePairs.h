#pragma once

// Pairs of reference and candidate files for a comparison.

#include "cli/InputFiles.h"

#include <pacini/foundation/Result.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pacini::cli
{

/// A reference, its candidate, and the clip that states the candidate's events (may be empty). `name` is the
/// reference's path below the folder that the user named, or just its name.
struct ComparePair
{
    std::filesystem::path name;
    std::filesystem::path reference;
    std::filesystem::path candidate;
    std::filesystem::path events;
};

/// A file that has no pair; `name` as of a pair.
struct PairFailure : InputFailure
{
    std::string name;
};

struct ComparePairs
{
    std::vector<ComparePair> pairs;
    std::vector<PairFailure> failures;           ///< references without a counterpart, unreadable folders
    std::vector<std::filesystem::path> leftOver; ///< candidates without a reference
};

/// Returns the pairs to compare. Two files are a pair. Two folders (with all subfolders) give a pair for each two files
/// whose paths agree except for their extensions; `events` is then a folder of clips, matched in the same way.
/// Otherwise `events` is one clip, or empty. A candidate is a sound, or else a clip. ErrorCode::invalidArgument for a
/// folder with a file.
[[nodiscard]] Result<ComparePairs> pairFiles(const std::string& reference, const std::string& candidate,
                                             const std::string& events);

} // namespace pacini::cli
