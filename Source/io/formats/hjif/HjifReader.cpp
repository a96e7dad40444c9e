#include "io/formats/ForeignText.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/hjif/HjifImport.h"

namespace pacini
{

namespace
{
std::optional<Error> readHjifClip(const nlohmann::json& tree, ImportedClip& imported)
{
    const auto file = readHjifFile(tree, imported.warnings);
    if (!file)
        return file.error();
    return importHjif(*file, imported);
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
