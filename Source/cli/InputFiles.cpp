#include "cli/InputFiles.h"

#include "cli/Manifest.h"
#include "io/AtomicFile.h"
#include "io/ClipFile.h"
#include "io/FileExtension.h"
#include "io/Overwrite.h"

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

namespace pacini::cli
{

namespace fs = std::filesystem;

namespace
{
bool isHidden(const fs::path& path)
{
    const auto name = path.filename().string();
    return !name.empty() && name.front() == '.';
}

/// Whether files of this extension are what the command writes or reads.
bool isFileExtension(const std::string& extension)
{
    const auto among = [&](const std::vector<std::string>& extensions)
    {
        return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
    };
    return clipFormatWrittenTo(extension) != nullptr || among(audioExtensions()) || among(clipFileExtensions());
}

/// The C library of mingw-w64 would list another folder in the place of one with a long path.
bool canBeListed([[maybe_unused]] const fs::path& folder, [[maybe_unused]] InputFiles& found)
{
#if defined(__MINGW32__)
    std::error_code ignored;
    if (fs::absolute(folder, ignored).native().size() >= 260)
    {
        found.failures.push_back({folder,
                                  {ErrorCode::io, "",
                                   "cannot be listed, as its path is longer than 259 characters; move it to "
                                   "a shorter one"}});
        return false;
    }
#endif
    return true;
}

void addFolder(const fs::path& folder, const std::vector<std::string>& extensions, InputFiles& found)
{
    if (!canBeListed(folder, found))
        return;
    std::error_code error;
    std::vector<fs::path> paths;
    fs::recursive_directory_iterator entry(folder, error);
    while (!error && entry != fs::recursive_directory_iterator())
    {
        const fs::path path = entry->path();
        std::error_code ignored;
        if (entry->is_directory(ignored) && (isHidden(path) || !canBeListed(path, found)))
            entry.disable_recursion_pending();
        else if (!isHidden(path) && !isManifestName(path) &&
                 std::find(extensions.begin(), extensions.end(), lowerExtension(path)) != extensions.end())
        {
            const auto status = entry->status(ignored);
            if (fs::is_regular_file(status))
                paths.push_back(path);
            else if (entry->is_symlink(ignored) && !fs::exists(status))
                found.failures.push_back({path,
                                          {ErrorCode::io, "",
                                           "is a link to a file that is not there; restore that file, or remove the "
                                           "link"}});
        }
        entry.increment(error);
    }
    if (error)
        found.failures.push_back(
            {folder, {ErrorCode::io, "", "cannot be listed: " + error.message() + "; check its permissions"}});
    std::sort(paths.begin(), paths.end());
    for (const auto& path : paths)
        found.files.push_back({path, path.lexically_relative(folder)}); // of a link where it stands, not where it leads
    if (paths.empty() && !error)
        found.failures.push_back({folder, {ErrorCode::invalidData, "", "contains no files that this command reads"}});
}
} // namespace

bool namesFolder(const std::string& output)
{
    std::error_code unknown;
    return output.back() == '/' || output.back() == fs::path::preferred_separator || fs::is_directory(output, unknown);
}

InputFiles findInputs(const std::vector<std::string>& named, const std::vector<std::string>& extensions)
{
    InputFiles found;
    found.several = named.size() > 1;
    for (const auto& name : named)
    {
        const fs::path path(name);
        std::error_code error;
        const auto status = fs::status(path, error);
        if (name == "-")
            found.files.push_back({path, "stdin"});
        else if (fs::is_directory(status))
        {
            found.several = true;
            addFolder(path, extensions, found);
        }
        else
            found.files.push_back({path, path.filename()}); // what is wrong with it, its reader says
    }
    std::set<fs::path> seen;
    std::erase_if(found.files, [&](const InputFile& file) { return !seen.insert(sameFileKey(file.path)).second; });
    return found;
}

Result<OutputPlace> outputFor(const InputFile& input, const OutputNames& names, bool several, bool makeFolders)
{
    fs::path path;
    std::error_code error;
    if (names.given.empty())
    {
        path = input.path;
        path.replace_extension(names.beside);
        return OutputPlace{path};
    }
    const bool folder = several || namesFolder(names.given);
    if (!folder)
        return OutputPlace{names.given, true};
    path = fs::path(names.given) / input.relative;
    if (makeFolders)
        fs::create_directories(path.parent_path(), error);
    if (error)
        return Error{ErrorCode::io, "",
                     "the folder " + path.parent_path().string() + " cannot be made (" + error.message() +
                         "); name another with -o"};
    const bool beside = sameFileKey(path) == sameFileKey(input.path);
    path.replace_extension(beside ? names.beside : names.extension);
    return OutputPlace{path};
}

Result<void> checkOutput(const InputFiles& inputs, const std::string& output, bool json)
{
    const auto wrong = [&](std::string message)
    {
        return Error{ErrorCode::invalidArgument, output, std::move(message)};
    };
    const bool takesStandardInput =
        std::any_of(inputs.files.begin(), inputs.files.end(), [](const InputFile& file) { return file.path == "-"; });
    if (output.empty())
    {
        if (takesStandardInput)
            return wrong("standard input has no folder for the output; name a file with -o, or - for standard output");
        return {};
    }
    if (json && isStandardOutput(output))
        return wrong("is used by the report of --json; name a file with -o");
    std::error_code unknown;
    if (!inputs.several || namesFolder(output))
        return {};
    if (isStream(output) || fs::exists(output, unknown))
        return wrong("is not a folder, but there are several inputs; name a folder with -o");
    if (isFileExtension(lowerExtension(output)))
        return wrong("looks like a file, but there are several inputs; name a folder, or write -o " + output +
                     "/ if it is a folder");
    return {};
}

} // namespace pacini::cli
