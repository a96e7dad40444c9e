// SPDX-License-Identifier: MIT
/// @file
/// Where a document belongs that was given in the place of another.
#pragma once

#include <string_view>

namespace pacini::detail
{

/// The end of a message on a document whose format is named `given`: what such documents are for. Empty for formats
/// that are not Pacini's, and in the runtime, which neither commands nor an editor belong to.
[[nodiscard]] inline const char* useOfFormat([[maybe_unused]] std::string_view given)
{
#if !defined(PACINI_READERS_ONLY)
    struct Use
    {
        const char* name;
        const char* use;
    };
    static constexpr Use uses[] = {
        {"clip", "; clips are for 'pacini render'"},  {"texture", "; textures are for scenes and 'pacini texture'"},
        {"profile", "; profiles are for --profile"},  {"settings", "; settings are for --settings"},
        {"project", "; projects are for the editor"},
    };
    constexpr std::string_view start = "pacini.";
    if (given.substr(0, start.size()) == start)
        given.remove_prefix(start.size());
    else
        return "";
    for (const auto& [name, use] : uses)
        if (given == name)
            return use;
#endif
    return "";
}

} // namespace pacini::detail
