#include "document/RecentFiles.h"

#include "io/AtomicFile.h"
#include "io/InputFile.h"
#include "io/JsonTree.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace pacini
{

namespace fs = std::filesystem;

RecentFiles::RecentFiles(fs::path listFile) : file(std::move(listFile))
{
    constexpr std::size_t largest = 1 << 20;
    const auto text = readWholeFile(file, largest);
    if (!text)
        return;
    const auto tree = readJsonTree(*text, largest);
    if (!tree || !tree->is_object() || !tree->contains("files") || !(*tree)["files"].is_array())
        return;
    for (const auto& entry : (*tree)["files"])
        if (entry.is_string() && list.size() < most)
        {
            const auto& path = entry.get_ref<const std::string&>();
            list.emplace_back(std::u8string(path.begin(), path.end()));
        }
}

Result<void> RecentFiles::add(const fs::path& project)
{
    std::error_code error;
    const fs::path path = fs::absolute(project, error).lexically_normal();
    std::erase(list, path);
    list.insert(list.begin(), path);
    list.resize(std::min(list.size(), most));
    return write();
}

Result<void> RecentFiles::remove(const fs::path& project)
{
    std::erase(list, project);
    return write();
}

Result<void> RecentFiles::clear()
{
    list.clear();
    return write();
}

bool RecentFiles::exists(const fs::path& project)
{
    std::error_code error;
    return fs::is_regular_file(project, error);
}

Result<void> RecentFiles::write() const
{
    nlohmann::json tree = {{"format", "pacini.recent"}, {"version", 1}, {"files", nlohmann::json::array()}};
    for (const fs::path& path : list)
    {
        const auto text = path.generic_u8string();
        tree["files"].push_back(std::string(text.begin(), text.end()));
    }
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    const std::string text = tree.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    if (auto written = writeFileAtomically(file, std::string_view(text)); !written)
        return written.error();
    return {};
}

} // namespace pacini
