#include "io/formats/json/JsonFormat.h"

#include "io/ReadWarnings.h"
#include "io/formats/json/ClipJson.h"

#include <utility>

namespace pacini
{

bool looksLikeJson(std::string_view bytes)
{
    if (bytes.starts_with(std::string_view("\xFF\xFE{\0", 4)) || bytes.starts_with(std::string_view("\xFE\xFF\0{", 4)))
        return true;
    if (bytes.starts_with("\xEF\xBB\xBF"))
        bytes.remove_prefix(3);
    const auto first = bytes.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && bytes[first] == '{';
}

bool isClipJson(std::string_view bytes)
{
    constexpr std::size_t start = 1024;
    return looksLikeJson(bytes) && bytes.substr(0, start).find(clipFormatName) != std::string_view::npos;
}

Result<ImportedClip> readClipJsonFile(std::string_view bytes, bool strict)
{
    ReadWarnings warnings(strict);
    auto clip = readClipJson(bytes, largestClipText, &warnings);
    if (!clip)
        return clip.error();
    return ImportedClip{std::move(clip).value(), warnings.texts()};
}

void streamClipJson(Clip clip, const ClipFormat::PieceSink& sink)
{
    writeClipJson(clip, sink);
}

} // namespace pacini
