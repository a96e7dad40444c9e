#pragma once

// Overwrite policy: which existing files a command may replace by its results.
//
// A file that the user named as the output is replaced, unless it is one of the inputs or what they were made from.
// Any other is replaced only when it was made by Pacini from the same input and is still as it was made; otherwise
// the command fails on this input and says so. -n leaves all that exist, -y replaces all.

#include "io/AtomicFile.h"
#include "io/FileOrigin.h"
#include "io/formats/ClipFormat.h"

#include <pacini/foundation/Result.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <string_view>

namespace pacini::cli
{

/// Permission to replace a file that stands at the place of one result.
enum class Replaceable
{
    own,   ///< what Pacini made from the same input
    named, ///< the file that -o names
    any,   ///< everything: -y
};

/// -n and -y, declared once per command.
class OverwriteOptions
{
public:
    void declare(CLI::App& command);

    [[nodiscard]] bool keepsAll() const noexcept { return keep; }
    [[nodiscard]] bool replacesAll() const noexcept { return replace; }

    /// For a file that the user named, or did not.
    [[nodiscard]] Replaceable of(bool named) const noexcept;

private:
    bool keep = false;
    bool replace = false;
};

/// Whether something stands at `path` that could be lost; a stream has nothing to lose.
[[nodiscard]] bool isOccupied(const std::filesystem::path& path);

/// Why the file at `output` is not replaced: "exists and `reason`; ...", with what to do.
[[nodiscard]] Error notReplaced(const std::filesystem::path& output, const std::string& reason);

/// How a file with that origin may be written to `output`. Errors: io, with what to do.
[[nodiscard]] Result<Existing> mayReplace(const std::filesystem::path& output, const FileOrigin& origin,
                                          Replaceable allowed);

/// The same for a file of a format that has no room for its origin: what is there already must be the same `bytes`.
[[nodiscard]] Result<Existing> mayReplace(const std::filesystem::path& output, std::string_view bytes,
                                          Replaceable allowed);

/// The same for all files of an export whose main file is `main`; how that one may be written.
[[nodiscard]] Result<Existing> mayReplace(const std::filesystem::path& main, const ExportedClip& exported,
                                          Replaceable allowed);

} // namespace pacini::cli
