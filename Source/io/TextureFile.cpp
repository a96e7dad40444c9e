#include "io/TextureFile.h"

#include "io/FieldsDocument.h"
#include "io/FieldsWriter.h"
#include "io/InputFile.h"
#include "io/TextureFields.h"

#include <utility>

namespace pacini
{

Result<Texture> readTextureJson(std::string_view text, ReadWarnings* warnings)
{
    return validated(
        readDocument<Texture>(text, {"a texture", textureFormatName, textureFormatVersion, largestTextureText},
                              warnings, [](auto& texture, auto& reader) { textureFields::content(texture, reader); }));
}

std::string textureJson(const Texture& texture)
{
    FieldsWriter writer(FieldsWriter::Layout::spaced);
    writer.format({textureFormatName, textureFormatVersion});
    textureFields::content(texture, writer);
    return std::move(writer).document();
}

Result<Texture> readTexture(const std::filesystem::path& path, ReadWarnings* warnings)
{
    const auto text = readWholeFile(path, largestTextureText);
    return text ? readTextureJson(*text, warnings) : text.error();
}

} // namespace pacini
