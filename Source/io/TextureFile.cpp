#include "io/TextureFile.h"

#include "io/FieldsReader.h"
#include "io/FieldsWriter.h"
#include "io/InputFile.h"
#include "io/JsonTree.h"
#include "io/TextureFields.h"

#include <utility>

namespace pacini
{

Result<Texture> readTextureJson(std::string_view text, ReadWarnings* warnings)
{
    const auto document = readJsonObject(text, largestTextureText, "is not a texture, as it is not a JSON object");
    if (!document)
        return document.error();
    FieldsReader reader(*document, warnings);
    reader.format(textureFormatName, textureFormatVersion);
    Texture texture;
    textureFields::content(texture, reader);
    reader.finish();
    if (reader.error)
        return *reader.error;
    if (auto valid = validate(texture); !valid)
        return valid.error();
    return texture;
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
