#include "io/ShippedProfiles.h"

#include "ShippedProfileTexts.h"
#include "io/NearestName.h"
#include "io/ProfileJson.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <system_error>
#include <utility>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
/// In the order of the plugin's parameter `profile`; never reordered, new ones at the end.
constexpr std::array<std::string_view, 20> slotNames{"flat-pcm",
                                                     "l5-wristband",
                                                     "l5-test-jig",
                                                     "lra-175",
                                                     "lra-235-narrow",
                                                     "erm-coin",
                                                     "piezo",
                                                     "phone-taptic",
                                                     "quest-controller",
                                                     "dualsense-voice-coil",
                                                     "joycon-hd-rumble",
                                                     "wideband-exciter",
                                                     "eap",
                                                     "phone-erm",
                                                     "phone-lra-z",
                                                     "phone-lra-x",
                                                     "phone-voice-coil",
                                                     "phone-piezo",
                                                     "bass-shaker",
                                                     "seat-shaker"};
} // namespace

std::string_view profileNameOf(std::size_t slot) noexcept
{
    return slot < slotNames.size() ? slotNames[slot] : std::string_view();
}

std::optional<Profile> builtInProfile(std::size_t slot)
{
    for (const auto& [name, text] : shippedProfileTexts)
    {
        if (name != profileNameOf(slot))
            continue;
        auto profile = readProfileJson(text);
        assert(profile.ok());
        return profile ? std::optional(std::move(profile).value()) : std::nullopt;
    }
    return std::nullopt;
}

std::vector<NamedProfile> builtInProfiles()
{
    std::vector<NamedProfile> profiles;
    for (std::size_t slot = 0; slot < slotNames.size(); ++slot)
        if (auto profile = builtInProfile(slot))
            profiles.push_back(
                {std::string(slotNames[slot]), std::make_shared<const Profile>(std::move(profile).value())});
    return profiles;
}

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
