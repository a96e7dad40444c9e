#include "io/ClipFile.h"

#include "io/ClipJson.h"
#include "io/InputFile.h"

#include <pacini/clip/PackedClip.h>

#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace pacini
{

namespace
{
constexpr std::string_view packedMagic = "PACB";

bool looksLikeJson(std::string_view bytes)
{
    // UTF-16 is refused by the reader of JSON, which says so.
    if (bytes.starts_with(std::string_view("\xFF\xFE{\0", 4)) || bytes.starts_with(std::string_view("\xFE\xFF\0{", 4)))
        return true;
    if (bytes.starts_with("\xEF\xBB\xBF"))
        bytes.remove_prefix(3);
    const auto first = bytes.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && bytes[first] == '{';
}

bool isBlank(std::string_view bytes)
{
    return bytes.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

/// The first bytes of a file; empty when it cannot be read.
std::string startOf(const std::filesystem::path& path)
{
    const auto file = openForReading(path);
    std::string start(64, '\0');
    start.resize(file ? std::fread(start.data(), 1, start.size(), file->get()) : 0);
    return start;
}

Error notAClip()
{
    return {ErrorCode::invalidData, "", "is not a clip: neither JSON nor packed; encode audio to get a clip"};
}
} // namespace

Result<std::string> readClipBytes(const std::filesystem::path& path)
{
    // A recording of hundreds of megabytes is not read just to find that it is no clip. Pipes can be read only once.
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored))
        if (const auto start = startOf(path);
            !isBlank(start) && !start.starts_with(packedMagic) && !looksLikeJson(start))
            return notAClip();
    return readWholeFile(path, largestClipText);
}

Result<Clip> clipOf(std::string_view bytes, ReadWarnings* warnings)
{
    if (bytes.starts_with(packedMagic))
        return unpackClip(std::as_bytes(std::span<const char>(bytes)));
    if (looksLikeJson(bytes))
        return readClipJson(bytes, largestClipText, warnings);
    if (bytes.empty())
        return Error{ErrorCode::invalidData, "", "is empty; it has no clip"};
    return notAClip();
}

Result<Clip> readClip(const std::filesystem::path& path, ReadWarnings* warnings)
{
    const auto bytes = readClipBytes(path);
    if (!bytes)
        return bytes.error();
    return clipOf(*bytes, warnings);
}

std::optional<ClipFormat> clipFormatOf(const std::filesystem::path& path)
{
    const auto start = startOf(path);
    if (start.starts_with(packedMagic))
        return ClipFormat::packed;
    return looksLikeJson(start) ? std::optional(ClipFormat::json) : std::nullopt;
}

Result<std::size_t> writeClip(const std::filesystem::path& path, Clip clip, ClipFormat format, Existing existing)
{
    if (auto valid = validate(clip); !valid)
        return valid.error();
    if (format == ClipFormat::packed)
    {
        const PackParams params = packParamsFor(clip);
        return writeFileAtomically(path, packClip(std::move(clip), params), existing);
    }
    auto file = AtomicFile::create(path, existing);
    if (!file)
        return file.error();
    std::size_t bytes = 0;
    writeClipJson(clip,
                  [&](std::string_view piece)
                  {
                      bytes += piece.size();
                      file->write(std::as_bytes(std::span<const char>(piece)));
                  });
    if (auto done = file->commit(); !done)
        return done.error();
    return bytes;
}

} // namespace pacini
