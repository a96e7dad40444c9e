#include "io/TextureFile.h"

#include "io/FieldsReader.h"
#include "io/FieldsWriter.h"
#include "io/InputFile.h"
#include "io/JsonTree.h"

#include <utility>

namespace pacini
{

namespace
{
/// Shows `visitor` (FieldsReader or FieldsWriter) all entries in the order of the file.
template <typename AnyTexture, typename Visitor>
void visitTexture(AnyTexture& texture, Visitor& visitor)
{
    using enum Need;
    visitor.optionalText("name", texture.name);
    visitNumbers(visitor, usual, "fullSpeed", texture.fullSpeed, "fullForce", texture.fullForce);
    visitNumbers(visitor, required, "pitch", texture.pitch, "levelBySpeed", texture.levelBySpeed, "levelByForce",
                 texture.levelByForce);
    visitor.list("nodes", texture.nodes, limits::textureNodes, "nodes",
                 [&](auto& node)
                 {
                     visitNumbers(visitor, required, "speed", node.speed, "level", node.level);
                     visitor.numbers("reflection", node.reflection, limits::textureOrder);
                 });
}
} // namespace

Result<Texture> readTextureJson(std::string_view text, ReadWarnings* warnings)
{
    const auto document = readJsonObject(text, largestTextureText, "is not a texture, as it is not a JSON object");
    if (!document)
        return document.error();
    FieldsReader reader(*document, warnings);
    reader.format(textureFormatName, textureFormatVersion);
    Texture texture;
    visitTexture(texture, reader);
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
    visitTexture(texture, writer);
    return std::move(writer).document();
}

Result<Texture> readTexture(const std::filesystem::path& path, ReadWarnings* warnings)
{
    const auto text = readWholeFile(path, largestTextureText);
    return text ? readTextureJson(*text, warnings) : text.error();
}

} // namespace pacini
