#include "document/FilesInTheWay.h"

#include "document/Document.h"

#include <algorithm>

namespace pacini
{

ProjectFileSet filesOf(const Document& document)
{
    return {document.project().sources, document.path()};
}

Result<std::vector<StandingFile>> filesInTheWay(std::span<const std::filesystem::path> results,
                                                const ProjectFileSet& needed)
{
    auto standing = standingAt(results);
    for (const StandingFile& file : standing)
    {
        const auto refused = [&file](const char* why)
        {
            return Error{ErrorCode::io, file.path.filename().string(), why};
        };
        if (file.kind == FileKind::folder)
            return refused("is a folder; choose another name");
        if (!needed.project.empty() && isSameFile(needed.project, file.path))
            return refused("is the open project, which is not overwritten; choose another name");
        if (std::any_of(needed.sounds.begin(), needed.sounds.end(),
                        [&file](const AudioReference& sound) { return isFileOf(sound, file.path); }))
            return refused("is a sound of this project, which is never overwritten; choose another name");
    }
    return standing;
}

} // namespace pacini
