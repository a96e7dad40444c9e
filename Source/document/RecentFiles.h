#pragma once

// List of the projects that were open last.

#include "document/WorkPlace.h"

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <vector>

namespace pacini
{

/// A list of project files, newest first, with the place where each was worked on, kept in a small JSON file.
class RecentFiles
{
public:
    static constexpr std::size_t most = 12;

    /// Reads the list; a missing or damaged one is an empty list.
    explicit RecentFiles(std::filesystem::path listFile);

    /// Puts a project first, and writes the list. Errors: io; the list in memory has it all the same.
    Result<void> add(const std::filesystem::path& project);
    Result<void> remove(const std::filesystem::path& project);
    Result<void> clear();

    /// Keeps where a project of the list was worked on, and writes the list; others are left alone. Errors: io.
    Result<void> setPlace(const std::filesystem::path& project, const WorkPlace& place);
    /// Where it was worked on last; the beginning, where that is not known.
    [[nodiscard]] WorkPlace placeOf(const std::filesystem::path& project) const;

    /// All of them; those that are not there any more too (a disk may be unplugged), see exists().
    [[nodiscard]] const std::vector<std::filesystem::path>& files() const noexcept { return list; }
    [[nodiscard]] static bool exists(const std::filesystem::path& project);

private:
    Result<void> write() const;

    std::filesystem::path file;
    std::vector<std::filesystem::path> list;
    std::map<std::filesystem::path, WorkPlace> places; ///< of those in the list
};

} // namespace pacini
