#include "io/formats/json/ClipJson.h"

#include "io/FieldsHandler.h"
#include "io/FieldsWriter.h"
#include "io/formats/json/ClipFields.h"

#include <utility>

namespace pacini
{

Result<Clip> readClipJson(std::string_view text, std::size_t maximumBytes, ReadWarnings* warnings)
{
    Clip clip;
    FieldsHandler handler(clip, clipFields::document);
    if (auto parsed = parseJson(text, handler, maximumBytes, warnings); !parsed)
        return parsed.error();
    if (auto valid = validate(clip); !valid)
        return valid.error();
    return clip;
}

std::string writeClipJson(const Clip& clip)
{
    constexpr std::size_t bytesPerPoint = 64;
    std::string text;
    text.reserve(1024 + bytesPerPoint * (breakpointCount(clip) + clip.transients.size()));
    writeClipJson(clip, [&text](std::string_view piece) { text += piece; });
    return text;
}

void writeClipJson(const Clip& clip, const TextSink& sink)
{
    FieldsWriter writer(FieldsWriter::Layout::lines, &sink);
    clipFields::document(clip, writer);
    sink(std::move(writer).document());
}

} // namespace pacini
