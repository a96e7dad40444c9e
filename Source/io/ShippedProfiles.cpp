#include "io/ShippedProfiles.h"

#include "io/NearestName.h"

#include <algorithm>
#include <system_error>

namespace pacini
{

namespace fs = std::filesystem;

std::vector<ShippedProfile> shippedProfiles(const fs::path& beside)
{
    constexpr int foldersUp = 6;
    std::vector<ShippedProfile> found;
    std::error_code error;
    fs::path folder = fs::absolute(beside, error);
    for (int up = 0; up < foldersUp && !folder.empty() && found.empty(); ++up, folder = folder.parent_path())
        for (const fs::path& place : {folder / "profiles", folder / "share" / "pacini" / "profiles"})
        {
            for (fs::directory_iterator entry(place, error); !error && entry != fs::directory_iterator();
                 entry.increment(error))
                if (entry->path().extension() == ".json")
                    found.push_back({entry->path().stem().string(), entry->path()});
            if (!found.empty())
                break;
        }
    std::sort(found.begin(), found.end(),
              [](const ShippedProfile& a, const ShippedProfile& b) { return a.name < b.name; });
    return found;
}

Result<fs::path> findProfile(const std::string& name, const fs::path& beside)
{
    std::error_code error;
    if (fs::is_regular_file(name, error))
        return fs::path(name);
    const auto shipped = shippedProfiles(beside);
    std::vector<std::string> names;
    std::string list;
    for (const ShippedProfile& profile : shipped)
    {
        if (profile.name == name)
            return profile.path;
        names.push_back(profile.name);
        list += (list.empty() ? "; there are " : ", ") + profile.name;
    }
    const std::string meant = meantText(name, names);
    return Error{ErrorCode::io, "", "is neither a file nor a shipped profile" + (meant.empty() ? list : meant)};
}

} // namespace pacini
