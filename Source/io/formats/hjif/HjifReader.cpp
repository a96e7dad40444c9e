#include "io/formats/ForeignText.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/hjif/HjifImport.h"

#include <algorithm>
#include <utility>

namespace pacini
{

bool isHjif(std::string_view bytes)
{
    constexpr auto none = std::string_view::npos;
    return bytes.find("\"perceptions\"") != none && bytes.find("\"avatars\"") != none;
}

Result<ImportedClip> readHjif(std::string_view bytes)
{
    ImportedClip result;
    const auto tree = readForeignTree(bytes, result.warnings);
    if (!tree)
        return tree.error();
    const auto file = readHjifFile(*tree, result.warnings);
    if (!file)
        return file.error();
    auto clip = clipOfHjif(*file, result.warnings);
    if (!clip)
        return clip.error();
    result.clip = std::move(clip).value();
    result.clip.name = file->description.substr(0, limits::text / 2);
    if (result.clip.bands.empty() && result.clip.transients.empty())
    {
        const bool hadMore = std::any_of(file->perceptions.begin(), file->perceptions.end(),
                                         [](const HjifPerception& p) {
                                             return std::any_of(p.channels.begin(), p.channels.end(),
                                                                [](const HjifChannel& c) { return !c.bands.empty(); });
                                         });
        if (hadMore)
            return Error{ErrorCode::invalidData, "perceptions", "hold nothing that can be read as vibration in time"};
        result.warnings.push_back("perceptions: nothing sounds");
    }
    if (auto valid = validate(result.clip); !valid)
        return valid.error();
    return result;
}

} // namespace pacini
