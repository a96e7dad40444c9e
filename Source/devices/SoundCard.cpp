#include "devices/SoundCard.h"

#if defined(__linux__)

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>
#include <vector>

namespace pacini::devices
{

namespace
{
namespace fs = std::filesystem;

std::vector<fs::path> foldersIn(const fs::path& folder)
{
    std::vector<fs::path> folders;
    std::error_code failed;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed))
        if (fs::is_directory(at->path(), failed))
            folders.push_back(at->path());
    return folders;
}
} // namespace

std::optional<int> soundCardOf(const std::string& path)
{
    std::error_code failed;
    // The device of a node is that of HID, above which are the USB interface and the USB device with all its
    // interfaces.
    const fs::path hid = fs::canonical("/sys/class/hidraw/" + fs::path(path).filename().string() + "/device", failed);
    if (failed)
        return std::nullopt;
    for (const fs::path& interface : foldersIn(hid.parent_path().parent_path()))
        for (const fs::path& card : foldersIn(interface / "sound"))
        {
            const std::string name = card.filename().string();
            const std::string number = name.substr(std::min<std::size_t>(4, name.size()));
            if (name.compare(0, 4, "card") == 0 && !number.empty() && number.size() < 5 &&
                std::all_of(number.begin(), number.end(), [](unsigned char c) { return std::isdigit(c) != 0; }))
                return std::stoi(number);
        }
    return std::nullopt;
}

} // namespace pacini::devices

#else

namespace pacini::devices
{

std::optional<int> soundCardOf(const std::string&)
{
    return std::nullopt;
}

} // namespace pacini::devices

#endif
