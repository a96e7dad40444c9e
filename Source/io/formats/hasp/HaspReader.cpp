#include "io/JsonText.h"
#include "io/formats/ForeignText.h"
#include "io/formats/haptic/HapticFormat.h"
#include "io/formats/hasp/HaspFormat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace pacini
{

namespace
{
/// A clip of a project that says something.
struct ProjectClip
{
    std::string name;
    std::size_t index = 0;
    const nlohmann::json* haptic = nullptr;
};

std::vector<ProjectClip> clipsOf(const nlohmann::json& clips)
{
    std::vector<ProjectClip> found;
    for (std::size_t i = 0; i < clips.size(); ++i)
    {
        const auto haptic = clips[i].find("haptic"); // nothing in what is no object
        if (haptic == clips[i].end() || !haptic->is_object())
            continue;
        const auto name = clips[i].find("name");
        found.push_back(
            {name != clips[i].end() && name->is_string() ? name->get<std::string>() : std::string(), i, &*haptic});
    }
    return found;
}

std::string namesOf(const std::vector<ProjectClip>& clips)
{
    constexpr std::size_t maxNamed = 5;
    std::string names;
    for (std::size_t i = 0; i < std::min(clips.size(), maxNamed); ++i)
        names += fmt::format("{}'{}'", i > 0 ? ", " : "", shownText(clips[i].name));
    return names + (clips.size() > maxNamed ? ", ..." : "");
}

std::optional<Error> readProject(const nlohmann::json& project, ImportedClip& imported)
{
    const auto list = project.find("clips");
    if (list == project.end() || !list->is_array())
        return Error{ErrorCode::invalidData, "clips",
                     list == project.end() ? "is missing; a project of Haptics Studio has it"
                                           : "must be a list in brackets"};
    const auto clips = clipsOf(*list);
    constexpr const char* advice = "export them from Haptics Studio as .haptic files";
    if (clips.empty())
        return Error{ErrorCode::invalidData, "clips",
                     fmt::format("has no clip with haptics: this is a project of Haptics Studio; {}", advice)};
    if (clips.size() > 1)
        return Error{ErrorCode::invalidData, "clips",
                     fmt::format("has {} clips ({}): this is a project of Haptics Studio and not one clip; {}",
                                 clips.size(), namesOf(clips), advice)};
    const std::string where = fmt::format("clips[{}].haptic", clips[0].index);
    auto haptic = readHaptic(clips[0].haptic->dump());
    if (!haptic)
    {
        Error error = haptic.error();
        error.where = error.where.empty() ? where : where + "." + error.where;
        return error;
    }
    imported.clip = std::move(haptic->clip);
    if (!clips[0].name.empty())
        imported.clip.name = importedName(clips[0].name);
    for (const std::string& warning : haptic->warnings)
        imported.warnings.push_back(where + "." + warning);
    return {};
}
} // namespace

bool isHasp(std::string_view bytes)
{
    return bytes.find("\"clips\"") != std::string_view::npos && bytes.find("\"clipId\"") != std::string_view::npos;
}

Result<ImportedClip> readHasp(std::string_view bytes)
{
    return importForeign(bytes, readProject);
}

} // namespace pacini
