#pragma once

// Provenance: where the numbers of a profile come from.

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// Says of the number at `path`, or of all below it, where it was found: `{"drive", "datasheet of ..."}`. A text that
/// starts with "assumed" marks numbers that nobody measured.
struct ProfileSource
{
    std::string path; ///< as in the file, such as `resonance.frequency` or `equalizer[1]`
    std::string text;
    bool operator==(const ProfileSource&) const = default;
};

/// The sources of a profile, each path once, in the order of their bytes.
using ProfileSources = std::vector<ProfileSource>;

inline constexpr std::size_t maxProfileSources = 256;

/// Checks that there are at most maxProfileSources, sorted, each path once, none without path or text.
[[nodiscard]] inline Result<void> validate(const ProfileSources& sources)
{
    if (sources.size() > maxProfileSources)
        return Error{ErrorCode::tooLarge, "sources", "has more than 256 entries"};
    for (std::size_t i = 0; i < sources.size(); ++i)
    {
        if (sources[i].path.empty())
            return Error{ErrorCode::invalidData, "sources", "has an entry without a path"};
        const std::string where = "sources." + sources[i].path;
        if (sources[i].text.empty())
            return Error{ErrorCode::invalidData, where, "must say something"};
        if (i > 0 && !(sources[i - 1].path < sources[i].path))
            return Error{ErrorCode::invalidData, where, "is not in order, or is there twice"};
    }
    return {};
}

/// The source of the number at `path`: the entry that names it, else the nearest object or list around it that an entry
/// names. Null when there is none.
[[nodiscard]] inline const ProfileSource* sourceOf(const ProfileSources& sources, std::string_view path) noexcept
{
    const ProfileSource* nearest = nullptr;
    for (const ProfileSource& source : sources)
    {
        if (!path.starts_with(source.path))
            continue;
        const bool whole =
            path.size() == source.path.size() || path[source.path.size()] == '.' || path[source.path.size()] == '[';
        if (whole && (nearest == nullptr || source.path.size() > nearest->path.size()))
            nearest = &source;
    }
    return nearest;
}

/// Whether the source says that its numbers are not measured.
[[nodiscard]] inline bool isAssumed(const ProfileSource& source) noexcept
{
    return std::string_view(source.text).starts_with("assumed");
}

} // namespace pacini
