#include "io/formats/ForeignText.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/hjif/HjifImport.h"

#include <algorithm>
#include <utility>

namespace pacini
{

namespace
{
std::optional<Error> readHjifClip(const nlohmann::json& tree, ImportedClip& imported)
{
    const auto file = readHjifFile(tree, imported.warnings);
    if (!file)
        return file.error();
    auto clip = clipOfHjif(*file, imported.warnings);
    if (!clip)
        return clip.error();
    imported.clip = std::move(clip).value();
    imported.clip.name = importedName(file->description);
    if (imported.clip.bands.empty() && imported.clip.transients.empty())
    {
        const bool hadMore = std::any_of(file->perceptions.begin(), file->perceptions.end(),
                                         [](const HjifPerception& p) {
                                             return std::any_of(p.channels.begin(), p.channels.end(),
                                                                [](const HjifChannel& c) { return !c.bands.empty(); });
                                         });
        if (hadMore)
            return Error{ErrorCode::invalidData, "perceptions", "contain no vibration over time"};
        imported.warnings.push_back("perceptions: nothing is played");
    }
    return {};
}
} // namespace

bool isHjif(std::string_view bytes)
{
    constexpr auto none = std::string_view::npos;
    return bytes.find("\"perceptions\"") != none && bytes.find("\"avatars\"") != none;
}

Result<ImportedClip> readHjif(std::string_view bytes)
{
    return importForeign(bytes, readHjifClip);
}

} // namespace pacini
