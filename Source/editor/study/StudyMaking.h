// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Studies made and reported from the windows, by the functions that `pacini study` has.

#include "study/Study.h"

#include <pacini/foundation/Result.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pacini::editor
{

/// What a study is made of.
struct StudyWish
{
    std::string kind;                 ///< a template of studyTemplates()
    std::filesystem::path folder;     ///< for study.json and the answers; made where it is missing
    std::filesystem::path sounds;     ///< a folder, or one sound; empty: none
    std::vector<study::Group> groups; ///< empty: those of the template
};

/// Writes `study.json` as `pacini study new` does; returns its path. Errors: those of makeStudy(), setGroups() and
/// validate(); io or diskFull, also for a study that is there already. [any]
[[nodiscard]] Result<std::filesystem::path> makeStudyFile(const StudyWish& wish);

/// Lets `pacini study report` write the report beside a study; returns its page, an HTML file. A report that somebody
/// has changed is not replaced. Errors: io for a program that is not there, and what the program says. [worker]
[[nodiscard]] Result<std::filesystem::path> reportStudy(const std::filesystem::path& study);

} // namespace pacini::editor
