#include "cli/study/OpenStudy.h"

#include "cli/Options.h"
#include "study/StudyFile.h"
#include "study/StudyResults.h"

#include <system_error>
#include <utility>

namespace pacini::cli
{

CLI::App* addStudyCommand(CLI::App& app, const std::string& name, const std::string& description, std::string& study)
{
    auto* command = app.add_subcommand(name, description);
    addOption(*command, "study", study, "Folder or file of the study", "STUDY")->required();
    return command;
}

std::optional<OpenedStudy> openStudy(Console& console, const std::string& named)
{
    OpenedStudy opened;
    opened.file = study::studyFileOf(named);
    opened.folder = opened.file.parent_path();
    ReadWarnings warnings(console.isStrict());
    auto study = study::readStudy(opened.file, &warnings);
    if (!study)
    {
        console.error(opened.file.string(), study.error());
        return std::nullopt;
    }
    console.warnings(opened.file.string(), warnings.texts());
    opened.study = std::move(*study);
    return opened;
}

std::optional<study::StudyResults> openResults(Console& console, const std::string& named)
{
    auto results = study::readResults(named);
    if (!results)
    {
        console.error(named, results.error());
        return std::nullopt;
    }
    console.warnings(named, results->warnings);
    return std::move(*results);
}

std::string actuatorOf(const study::Study& study, const std::filesystem::path& folder, const std::string& given)
{
    std::error_code unknown;
    if (!given.empty() || study.profile.empty())
        return given;
    const std::filesystem::path beside = folder / study.profile;
    return std::filesystem::is_regular_file(beside, unknown) ? beside.string() : study.profile;
}

} // namespace pacini::cli
