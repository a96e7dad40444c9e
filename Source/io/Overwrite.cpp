#include "io/Overwrite.h"

#include "io/AudioReader.h"
#include "io/ClipFile.h"
#include "io/FileExtension.h"
#include "io/InputFile.h"
#include "io/ProfileFile.h"
#include "io/SceneFile.h"
#include "io/TextureFile.h"

#include <cstddef>
#include <string>
#include <system_error>
#include <variant>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
Error notReplaced(const fs::path& output, std::string reason)
{
    return {ErrorCode::io, output.string(), std::move(reason)};
}
} // namespace

bool isOccupied(const fs::path& path)
{
    std::error_code unknown;
    return !isStream(path) && fs::exists(fs::symlink_status(path, unknown));
}

Result<Existing> mayOverwrite(const fs::path& output, const FileOrigin& origin, Replaceable allowed)
{
    if (allowed != Replaceable::own)
        return Existing::replace;
    if (!isOccupied(output))
        return Existing::keep;
    const auto found = readOrigin(output);
    if (!found)
        return notReplaced(output, "exists and was not made by pacini");
    if (found->place != origin.place)
        return notReplaced(output, found->input == origin.input ? "was made from another " + found->input
                                                                : "was made from " + found->input);
    if (!isAsMade(output))
        return notReplaced(output, "was changed since pacini made it");
    return Existing::replace;
}

Result<Existing> mayOverwrite(const fs::path& output, std::string_view bytes, Replaceable allowed)
{
    if (allowed != Replaceable::own)
        return Existing::replace;
    if (!isOccupied(output))
        return Existing::keep;
    const auto there = readWholeFile(output, bytes.size());
    if (there && *there == bytes)
        return Existing::replace;
    return notReplaced(output, "exists with other content");
}

Result<Existing> mayOverwrite(const fs::path& main, const ExportedClip& exported, Replaceable allowed)
{
    Result<Existing> ofMain = Existing::replace;
    for (const ExportedFile& file : exported.files)
    {
        const auto one = mayOverwrite(file.suffix.empty() ? main : exportPath(main, file.suffix), file.bytes, allowed);
        if (!one || file.suffix.empty())
            ofMain = one;
        if (!one)
            break;
    }
    return ofMain;
}

FileKind kindOf(const fs::path& path)
{
    std::error_code unknown;
    if (fs::is_directory(path, unknown))
        return FileKind::folder;
    if (!fs::is_regular_file(path, unknown))
        return FileKind::other;
    if (AudioReader::open(path))
        return readOrigin(path) ? FileKind::madeSound : FileKind::sound;
    if (lowerExtension(path) == ".pacini")
        return FileKind::project;
    if (isProfile(path))
        return FileKind::profile;
    if (lowerExtension(path) == ".json" && readTexture(path))
        return FileKind::texture;
    if (const auto read = readClipOrScene(path))
        return std::holds_alternative<Scene>(read->content) ? FileKind::scene : FileKind::clip;
    return FileKind::other;
}

std::vector<StandingFile> standingAt(std::span<const fs::path> results)
{
    std::vector<StandingFile> standing;
    for (const fs::path& path : results)
        if (isOccupied(path))
            standing.push_back({path, kindOf(path)});
    return standing;
}

fs::path sameFileKey(const fs::path& path)
{
    // The folder's links are resolved, the file's own are not: two links to one file are two results.
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(fs::absolute(path, error).parent_path(), error);
    return error ? path.lexically_normal() : folder / path.filename();
}

fs::path realPlace(const fs::path& path)
{
    std::error_code error;
    const fs::path place = fs::weakly_canonical(fs::absolute(path, error), error);
    return error || place.empty() ? sameFileKey(path) : place;
}

bool isSameFile(const fs::path& one, const fs::path& other)
{
    std::error_code missing; // false then
    return realPlace(one) == realPlace(other) || fs::equivalent(one, other, missing);
}

} // namespace pacini
