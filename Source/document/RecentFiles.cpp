#include "document/RecentFiles.h"

#include "io/AtomicFile.h"
#include "io/FieldsReader.h"
#include "io/FieldsWriter.h"
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

namespace
{
struct PlaceEntry
{
    std::string path;
    WorkPlace place;
};

template <typename Entry, typename Visitor>
void visitEntry(Entry& entry, Visitor& visitor)
{
    visitor.text("path", entry.path);
    visitPlace(entry.place, visitor);
}

fs::path listedPath(const std::string& text)
{
    return fs::path(std::u8string(text.begin(), text.end()));
}

std::string listedText(const fs::path& path)
{
    const auto text = path.generic_u8string();
    return {text.begin(), text.end()};
}

fs::path wholePath(const fs::path& path)
{
    std::error_code error;
    return fs::absolute(path, error).lexically_normal();
}
} // namespace

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
            list.push_back(listedPath(entry.get_ref<const std::string&>()));
    FieldsReader reader(*tree);
    std::vector<PlaceEntry> read;
    reader.list("places", read, most, "places", [&](PlaceEntry& entry) { visitEntry(entry, reader); });
    if (!reader.error)
        for (const PlaceEntry& entry : read)
            places[listedPath(entry.path)] = entry.place;
}

Result<void> RecentFiles::add(const fs::path& project)
{
    const fs::path path = wholePath(project);
    std::erase(list, path);
    list.insert(list.begin(), path);
    list.resize(std::min(list.size(), most));
    return write();
}

Result<void> RecentFiles::setPlace(const fs::path& project, const WorkPlace& place)
{
    const fs::path path = wholePath(project);
    if (std::find(list.begin(), list.end(), path) == list.end() || placeOf(path) == place)
        return {};
    places[path] = place;
    return write();
}

WorkPlace RecentFiles::placeOf(const fs::path& project) const
{
    const auto found = places.find(wholePath(project));
    return found != places.end() ? found->second : WorkPlace{};
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
    FieldsWriter writer(FieldsWriter::Layout::spaced);
    writer.format({"pacini.recent", 1});
    nlohmann::json files = nlohmann::json::array();
    std::vector<PlaceEntry> entries;
    for (const fs::path& path : list)
    {
        files.push_back(listedText(path));
        if (const auto found = places.find(path); found != places.end())
            entries.push_back({listedText(path), found->second});
    }
    writer.json("files", files.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    writer.list("places", entries, most, "places", [&](const PlaceEntry& entry) { visitEntry(entry, writer); });
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    if (auto written = writeFileAtomically(file, std::string_view(std::move(writer).document())); !written)
        return written.error();
    return {};
}

} // namespace pacini
