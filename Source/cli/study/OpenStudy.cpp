#include "cli/study/OpenStudy.h"

#include "study/StudyFile.h"
#include "study/StudyResults.h"

#include <utility>

namespace pacini::cli
{

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

} // namespace pacini::cli
