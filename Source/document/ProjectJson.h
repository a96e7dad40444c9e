#pragma once

// Projects as JSON text.

#include "document/Project.h"
#include "document/WorkPlace.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace pacini
{

inline constexpr std::string_view projectFormatName = "pacini.project";
inline constexpr int projectFormatVersion = 1;

/// Longer texts are refused: embedded sounds are in them.
inline constexpr std::size_t largestProjectText = std::size_t(2) << 30;

/// Entry of an autosaved project about its origin.
struct RecoveryNote
{
    std::string path;   ///< of the project file; empty: it had none yet
    double time = 0.0;  ///< s since 1970 (UTC) when it was written
    double process = 0; ///< id of the process that wrote it
    WorkPlace place = {};
    bool operator==(const RecoveryNote&) const = default;
};

/// Options of writing a project.
struct ProjectTextOptions
{
    std::filesystem::path folder; ///< paths are written relative to it; empty: as they are
    bool embed = true;            ///< write embedded sounds; else the name of a file that holds them, see below
    const RecoveryNote* recovery = nullptr;
};

/// The text of a project whose clips pass validate(). readProjectJson(projectJson(p)) == p, except that bytes that are
/// not UTF-8 become U+FFFD and minus zero becomes zero.
[[nodiscard]] std::string projectJson(const Project& project, const ProjectTextOptions& options = {});

struct ReadProject
{
    Project project;
    std::optional<RecoveryNote> recovery;
};

/// Reads a project; relative paths count from `folder`. Embedded sounds that were left out (`embed` false) are read
/// from `HASH.sound` in `folder` where they are. Errors carry the place, such as `clips[2].clip.bands[0].amplitude`;
/// codes as in readClipJson(), and invalidData for an id given twice or a source that is not there.
[[nodiscard]] Result<ReadProject> readProjectJson(std::string_view text, const std::filesystem::path& folder = {});

} // namespace pacini
