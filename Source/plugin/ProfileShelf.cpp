// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/ProfileShelf.h"

#include "BinaryData.h"
#include "io/ProfileJson.h"

#include <array>
#include <cassert>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

namespace pacini::plugin
{

namespace
{
/// In the order of profileChoices; never reordered, new ones at the end.
constexpr std::array<std::string_view, 12> names{
    "flat-pcm",         "l5-wristband",    "l5-test-jig",  "lra-175",          "lra-235-narrow",
    "erm-coin",         "piezo",           "phone-taptic", "quest-controller", "dualsense-voice-coil",
    "joycon-hd-rumble", "wideband-exciter"};
} // namespace

std::string_view profileNameOf(std::size_t slot) noexcept
{
    return slot < names.size() ? names[slot] : std::string_view();
}

std::optional<Profile> shelfProfile(std::size_t slot)
{
    const std::string file = std::string(profileNameOf(slot)) + ".json";
    for (int i = 0; i < shippedProfileData::namedResourceListSize; ++i)
    {
        const char* resource = shippedProfileData::namedResourceList[i];
        if (file != shippedProfileData::getNamedResourceOriginalFilename(resource))
            continue;
        int size = 0;
        const char* data = shippedProfileData::getNamedResource(resource, size);
        auto profile = readProfileJson({data, static_cast<std::size_t>(size)});
        assert(profile.ok());
        return profile ? std::optional(std::move(profile).value()) : std::nullopt;
    }
    return std::nullopt;
}

std::vector<editor::NamedProfile> shelfProfiles()
{
    std::vector<editor::NamedProfile> profiles;
    for (std::size_t slot = 0; slot < names.size(); ++slot)
        if (auto profile = shelfProfile(slot))
            profiles.push_back({std::string(names[slot]), std::make_shared<const Profile>(std::move(profile).value())});
    return profiles;
}

} // namespace pacini::plugin
