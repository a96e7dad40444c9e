#include "document/BuiltInProfiles.h"

#include "ShippedProfileTexts.h"
#include "io/ProfileJson.h"

#include <array>
#include <cassert>
#include <utility>

namespace pacini
{

namespace
{
/// In the order of the plugin's parameter `profile`; never reordered, new ones at the end.
constexpr std::array<std::string_view, 12> names{
    "flat-pcm",         "l5-wristband",    "l5-test-jig",  "lra-175",          "lra-235-narrow",
    "erm-coin",         "piezo",           "phone-taptic", "quest-controller", "dualsense-voice-coil",
    "joycon-hd-rumble", "wideband-exciter"};
} // namespace

std::string_view profileNameOf(std::size_t slot) noexcept
{
    return slot < names.size() ? names[slot] : std::string_view();
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
    for (std::size_t slot = 0; slot < names.size(); ++slot)
        if (auto profile = builtInProfile(slot))
            profiles.push_back({std::string(names[slot]), std::make_shared<const Profile>(std::move(profile).value())});
    return profiles;
}

} // namespace pacini
