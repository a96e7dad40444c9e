#include "document/FolderFiles.h"

#include "io/AudioExtensions.h"
#include "io/ClipFile.h"
#include "io/FileExtension.h"

#include <algorithm>
#include <system_error>

namespace pacini
{

namespace fs = std::filesystem;

std::vector<std::string> openableExtensions()
{
    std::vector<std::string> all = audioExtensions();
    for (std::string extension : clipFileExtensions())
        if (std::find(all.begin(), all.end(), extension) == all.end())
            all.push_back(std::move(extension));
    return all;
}

std::vector<fs::path> openableFiles(const fs::path& folder)
{
    const auto extensions = openableExtensions();
    std::vector<fs::path> files;
    std::error_code error;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error), end;
    for (; !error && entry != end; entry.increment(error))
    {
        std::error_code ignored;
        if (entry->path().filename().string().starts_with('.'))
        {
            if (entry->is_directory(ignored))
                entry.disable_recursion_pending();
            continue;
        }
        const auto extension = lowerExtension(entry->path());
        if (entry->is_regular_file(ignored) &&
            std::find(extensions.begin(), extensions.end(), extension) != extensions.end())
            files.push_back(entry->path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace pacini
