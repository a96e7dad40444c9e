// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/study/StudyMaking.h"

#include "document/FolderFiles.h"
#include "editor/Text.h"
#include "io/AtomicFile.h"
#include "io/AudioExtensions.h"
#include "io/ChildProgram.h"
#include "io/FileExtension.h"
#include "study/StudyFile.h"
#include "study/StudyResults.h"
#include "study/StudyTemplates.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace pacini::editor
{

namespace
{
namespace fs = std::filesystem;

std::string utf8Of(const fs::path& path)
{
    return pathText(path).toStdString();
}

/// The command beside this program, else that of PATH.
std::string commandProgram()
{
    const auto beside =
        juce::File::getSpecialLocation(juce::File::currentExecutableFile)
            .getSiblingFile(juce::File::getSpecialLocation(juce::File::currentExecutableFile).hasFileExtension("exe")
                                ? "pacini.exe"
                                : "pacini");
    return beside.existsAsFile() ? beside.getFullPathName().toStdString() : std::string("pacini");
}
} // namespace

Result<fs::path> makeStudyFile(const StudyWish& wish)
{
    if (wish.folder.empty())
        return Error{ErrorCode::invalidArgument, "", "Choose a folder for the study."};
    std::error_code failed;
    std::vector<std::string> sounds;
    if (fs::is_directory(wish.sounds, failed))
    {
        for (const fs::path& file : openableFiles(wish.sounds))
            if (const auto& all = audioExtensions();
                std::find(all.begin(), all.end(), lowerExtension(file)) != all.end())
                sounds.push_back(utf8Of(file));
    }
    else if (!wish.sounds.empty())
    {
        if (!fs::is_regular_file(wish.sounds, failed))
            return Error{ErrorCode::io, utf8Of(wish.sounds), "does not exist; check the name and the folder"};
        sounds.push_back(utf8Of(wish.sounds));
    }
    for (const auto& one : study::studyTemplates())
        if (one.name == wish.kind && sounds.size() < one.fewestSounds)
            return Error{ErrorCode::invalidArgument, "",
                         one.fewestSounds == 1
                             ? std::string("This study needs a sound. Choose one, or a folder of them.")
                             : fmt::format("This study needs at least {} sounds, and {} were found. Choose a folder of "
                                           "them.",
                                           one.fewestSounds, sounds.size())};
    for (const auto& one : study::studyTemplates())
        if (one.name == wish.kind && one.mostSounds == 0 && !sounds.empty())
            return Error{ErrorCode::invalidArgument, "",
                         "This study presents no sounds. Leave the field of sounds empty."};
        else if (one.name == wish.kind && !sounds.empty() &&
                 (sounds.size() > one.mostSounds || sounds.size() < one.fewestOwn))
            return Error{ErrorCode::invalidArgument, "",
                         fmt::format("This study takes {} to {} sounds or none, and {} were found. Choose others.",
                                     one.fewestOwn, one.mostSounds, sounds.size())};
    auto made = study::makeStudy(wish.kind, sounds);
    if (!made)
        return made.error();
    if (!wish.groups.empty())
        if (auto set = study::setGroups(*made, wish.groups); !set)
            return set.error();
    const fs::path folder = fs::absolute(wish.folder, failed);
    const study::Study written = study::relocated(std::move(*made), fs::path(), folder);
    if (auto valid = study::validate(written); !valid)
        return valid.error();
    fs::create_directories(folder, failed);
    if (failed)
        return Error{ErrorCode::io, utf8Of(folder), failed.message()};
    const fs::path file = folder / study::studyFileName;
    if (auto done = writeFileAtomically(file, study::studyJson(written), Existing::keep); !done)
        return done.error();
    return file;
}

Result<fs::path> reportStudy(const fs::path& named)
{
    const fs::path file = study::studyFileOf(named);
    auto started = ChildProgram::start(commandProgram(), {"study", "report", utf8Of(file)});
    if (!started)
        return started.error();
    if (*started == nullptr)
        return Error{ErrorCode::io, "pacini", "is not installed beside this program; it writes the reports"};
    constexpr std::size_t most = 1'000'000;
    (void)allOutput(**started, most);
    const auto ended = (*started)->wait();
    if (!ended.succeeded)
    {
        // "pacini: FILE: where: what"
        std::string complaint = ended.complaint.substr(0, ended.complaint.find_last_not_of("\n ") + 1);
        if (const std::string start = "pacini: "; complaint.starts_with(start))
            complaint.erase(0, start.size());
        return Error{ErrorCode::io, "", std::move(complaint)};
    }
    return file.parent_path() / "report" / "report.html";
}

} // namespace pacini::editor
