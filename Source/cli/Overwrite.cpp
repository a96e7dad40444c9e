#include "cli/Overwrite.h"

#include <fmt/format.h>

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

Error notReplaced(const fs::path& output, const std::string& reason)
{
    return {ErrorCode::io, output.string(), fmt::format("{}; -y replaces it, -o writes elsewhere", reason)};
}

} // namespace pacini::cli
