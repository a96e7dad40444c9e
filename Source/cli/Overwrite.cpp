#include "cli/Overwrite.h"

#include "io/ClipFile.h"
#include "io/InputFile.h"

#include <fmt/format.h>

#include <system_error>

namespace pacini::cli
{

namespace fs = std::filesystem;

void OverwriteOptions::declare(CLI::App& command)
{
    auto* no = command.add_flag("-n,--no-overwrite", keep, "Leave every file that exists as it is");
    command
        .add_flag(
            "-y,--overwrite", replace,
            "Replace every file that exists [the one that -o names, and those that pacini made from the same input "
            "and nobody changed since]")
        ->excludes(no);
}

Replaceable OverwriteOptions::of(bool named) const noexcept
{
    return replace ? Replaceable::any : named ? Replaceable::named : Replaceable::own;
}

bool isOccupied(const fs::path& path)
{
    std::error_code unknown;
    return !isStream(path) && fs::exists(fs::symlink_status(path, unknown));
}

Error notReplaced(const fs::path& output, const std::string& reason)
{
    return {ErrorCode::io, output.string(), fmt::format("{}; -y replaces it, -o writes elsewhere", reason)};
}

Result<Existing> mayReplace(const fs::path& output, const FileOrigin& origin, Replaceable allowed)
{
    if (allowed != Replaceable::own)
        return Existing::replace;
    if (!isOccupied(output))
        return Existing::keep;
    const auto found = readOrigin(output);
    if (!found)
        return notReplaced(output, "exists, and nothing in it says that pacini made it");
    if (found->place != origin.place)
        return notReplaced(output, found->input == origin.input ? "was made from another " + found->input
                                                                : "was made from " + found->input);
    if (!isAsMade(output))
        return notReplaced(output, "was changed since pacini made it");
    return Existing::replace;
}

Result<Existing> mayReplace(const fs::path& output, std::string_view bytes, Replaceable allowed)
{
    if (allowed != Replaceable::own)
        return Existing::replace;
    if (!isOccupied(output))
        return Existing::keep;
    const auto there = readWholeFile(output, bytes.size());
    if (there && *there == bytes)
        return Existing::replace;
    return notReplaced(output, "exists and holds something else");
}

Result<Existing> mayReplace(const fs::path& main, const ExportedClip& exported, Replaceable allowed)
{
    Result<Existing> ofMain = Existing::replace;
    for (const ExportedFile& file : exported.files)
    {
        const auto one = mayReplace(file.suffix.empty() ? main : exportPath(main, file.suffix), file.bytes, allowed);
        if (!one || file.suffix.empty())
            ofMain = one;
        if (!one)
            break;
    }
    return ofMain;
}

} // namespace pacini::cli
