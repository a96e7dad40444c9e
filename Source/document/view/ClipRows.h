#pragma once

// List rows of a project's clips, under the headings of their groups.

#include "document/Project.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

/// The heading of a group, or a clip.
struct ClipRow
{
    int clip = 0;      ///< its id; 0: a heading
    std::string group; ///< empty: none
    bool operator==(const ClipRow&) const = default;
};

/// All groups in their order; those that only clips know come last.
[[nodiscard]] inline std::vector<std::string> groupsOf(const Project& project)
{
    auto groups = project.groups;
    for (const auto& item : project.clips)
        if (!item->group.empty() && std::find(groups.begin(), groups.end(), item->group) == groups.end())
            groups.push_back(item->group);
    return groups;
}

/// Clips without a group, then the groups, each with its clips in the order of the project.
[[nodiscard]] inline std::vector<ClipRow> clipRows(const Project& project)
{
    std::vector<ClipRow> rows;
    const auto addClips = [&](const std::string& group)
    {
        for (const auto& item : project.clips)
            if (item->group == group)
                rows.push_back({item->id, group});
    };
    addClips("");
    for (const std::string& group : groupsOf(project))
    {
        rows.push_back({0, group});
        addClips(group);
    }
    return rows;
}

/// Destination of a clip, for Document::placeClip().
struct ClipPlace
{
    std::size_t index = 0; ///< among the other clips
    std::string group;
    bool operator==(const ClipPlace&) const = default;
};

/// The place of clip `moved` when it is dropped above row `gap` (rows.size(): below the last): behind the clip above
/// it, in the group that begins or goes on there. `rows` are those of `project`.
[[nodiscard]] inline ClipPlace placeAbove(const Project& project, std::span<const ClipRow> rows, std::size_t gap,
                                          int moved)
{
    gap = std::min(gap, rows.size());
    ClipPlace place;
    if (gap > 0)
        place.group = rows[gap - 1].group;
    int before = 0;
    for (std::size_t r = gap; before == 0 && r-- > 0 && rows[r].clip != 0;)
        if (rows[r].clip != moved)
            before = rows[r].clip;
    std::size_t index = 0;
    for (const auto& item : project.clips)
    {
        if (item->id == moved)
            continue;
        if (item->id == before)
            return {index + 1, place.group};
        if (before == 0 && item->group == place.group)
            return {index, place.group};
        ++index;
    }
    return {index, place.group};
}

/// "Group", "Group 2" and so on: the first that the project does not have.
[[nodiscard]] inline std::string freeGroupName(const Project& project)
{
    const auto groups = groupsOf(project);
    std::string name = "Group";
    for (int number = 2; std::find(groups.begin(), groups.end(), name) != groups.end(); ++number)
        name = "Group " + std::to_string(number);
    return name;
}

} // namespace pacini
