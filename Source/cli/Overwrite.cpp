#include "cli/Overwrite.h"

#include "cli/Console.h"
#include "io/AtomicFile.h"

#include <fmt/format.h>

#include <algorithm>

namespace pacini::cli
{

namespace fs = std::filesystem;

void OverwriteOptions::declare(CLI::App& command)
{
    auto* no = command.add_flag("-n,--no-overwrite", keep, "Keep all existing files");
    command
        .add_flag("-y,--overwrite", replace,
                  "Replace all existing files [only the one named by -o, and unchanged files that pacini made from the "
                  "same input]")
        ->excludes(no);
}

bool OverwriteOptions::keeps(Console& console, std::initializer_list<fs::path> outputs) const
{
    const auto kept =
        std::find_if(outputs.begin(), outputs.end(),
                     [this](const fs::path& output) { return keep && !output.empty() && isOccupied(output); });
    if (kept != outputs.end())
        console.kept(*kept);
    return kept != outputs.end();
}

Replaceable OverwriteOptions::of(bool named) const noexcept
{
    return replace ? Replaceable::any : named ? Replaceable::named : Replaceable::own;
}

Result<void> checkStream(const fs::path& output, const ExportedClip& exported)
{
    if (exported.files.size() < 2 || !isStream(output))
        return {};
    return Error{ErrorCode::invalidArgument, output.string(),
                 fmt::format("takes one file, but this clip becomes {}; name a file with -o, or leave out --split",
                             exported.files.size())};
}

Error notReplaced(const fs::path& output, const std::string& reason)
{
    return {ErrorCode::io, output.string(), fmt::format("{}; -y replaces it, -o writes elsewhere", reason)};
}

} // namespace pacini::cli
