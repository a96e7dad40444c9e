#include "python/native/Overwriting.h"

#include "io/FileExtension.h"
#include "io/FileOrigin.h"
#include "io/InputFile.h"
#include "io/formats/ClipFormat.h"
#include "python/native/Support.h"

#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

namespace pacini::python
{

namespace fs = std::filesystem;

namespace
{
/// Whether it is, by its first bytes, a file of a format that is written and not read.
bool isOnlyWritten(const fs::path& path)
{
    const auto file = openForReading(path);
    std::string start(1024, '\0');
    start.resize(file ? std::fread(start.data(), 1, start.size(), file->get()) : 0);
    const ClipFormat* format = clipFormatOf(lowerExtension(path), start);
    return format != nullptr && !format->isRead();
}

/// What keeps a file from being replaced by one of this kind; null for nothing.
const char* reasonToKeep(const fs::path& path, FileKind there, FileKind kind)
{
    switch (there)
    {
    case FileKind::sound:
        return "is a sound that Pacini did not make";
    case FileKind::madeSound:
        return isAsMade(path) ? nullptr : "was changed since Pacini made it";
    case FileKind::clip:
        return kind == FileKind::clip ? nullptr : "is a clip";
    case FileKind::scene:
        return kind == FileKind::scene ? nullptr : "is a scene";
    case FileKind::texture:
        return kind == FileKind::texture ? nullptr : "is a texture";
    case FileKind::profile:
        return kind == FileKind::profile ? nullptr : "is the profile of an actuator";
    case FileKind::project:
        return "is a project of the editor";
    case FileKind::folder:
    case FileKind::other:
        break;
    }
    std::error_code unknown;
    const bool hasNothing = fs::is_regular_file(path, unknown) && fs::file_size(path, unknown) == 0;
    const bool isLike = kind == FileKind::clip && isOnlyWritten(path);
    return hasNothing || isLike ? nullptr : "exists, and nothing in it says that Pacini made it";
}
} // namespace

Existing mayWrite(const fs::path& path, FileKind kind, Overwrite overwrite, const Clip* clip,
                  const std::function<bool()>& isOwn)
{
    if (!isOccupied(path))
        return isStream(path) ? Existing::replace : Existing::keep;
    const auto refuse = [&path](const std::string& reason)
    {
        raise({ErrorCode::io, path.string(), reason});
    };
    if (overwrite == false)
        refuse("exists");
    const bool isSource = clip != nullptr && !clip->source.file.empty() && path.filename() == clip->source.file;
    if (overwrite == true && !isSource)
        return Existing::replace;
    const auto [there, reason] = unlocked(
        [&]
        {
            const FileKind found = kindOf(path);
            return std::pair(found, reasonToKeep(path, found, kind));
        });
    if (there == FileKind::folder)
        refuse("is a folder");
    if (there == FileKind::sound && isOwn && isOwn())
        return Existing::replace;
    if (isSource && there == FileKind::sound)
        refuse("is the recording that this clip was made from; name another file");
    if (overwrite != true && reason != nullptr)
        refuse(std::string(reason) + "; overwrite=True replaces it");
    return Existing::replace;
}

} // namespace pacini::python
