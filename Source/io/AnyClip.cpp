#include "io/AnyClip.h"

#include "io/ClipFile.h"
#include "io/ClipJson.h"
#include "io/InputFile.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <system_error>

namespace pacini
{

namespace
{
std::string lowerExtensionOf(const std::filesystem::path& path)
{
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool isForeignExtension(std::string_view extension)
{
    const auto formats = foreignFormats();
    return std::any_of(formats.begin(), formats.end(),
                       [&](const ForeignFormat& format)
                       { return format.read != nullptr && format.extension == extension; });
}

/// Its format is the first thing that a clip says.
bool saysItIsPacini(std::string_view bytes)
{
    constexpr std::size_t start = 1024;
    return bytes.substr(0, start).find(clipFormatName) != std::string_view::npos;
}

/// Adds the events of the second file.
Result<void> addCompanion(const std::filesystem::path& path, const ForeignFormat& format, AnyClip& read)
{
    const auto bytes = readWholeFile(path, largestClipText);
    auto more = bytes ? format.read(*bytes) : Result<ImportedClip>(bytes.error());
    if (!more)
    {
        Error error = more.error();
        error.where = path.filename().string() + (error.where.empty() ? "" : ": " + error.where);
        return error;
    }
    read.bytes += *bytes;
    Clip& clip = read.clip;
    clip.duration = std::max(clip.duration, more->clip.duration);
    std::vector<Transient> events;
    std::merge(clip.transients.begin(), clip.transients.end(), more->clip.transients.begin(),
               more->clip.transients.end(), std::back_inserter(events),
               [](const Transient& a, const Transient& b) { return a.time < b.time; });
    clip.transients = std::move(events);
    std::move(more->warnings.begin(), more->warnings.end(), std::back_inserter(read.warnings));
    return {};
}
} // namespace

Result<AnyClip> readAnyClip(const std::filesystem::path& path)
{
    const std::string extension = lowerExtensionOf(path);
    auto bytes = isForeignExtension(extension) ? readWholeFile(path, largestClipText) : readClipBytes(path);
    if (!bytes)
        return bytes.error();
    AnyClip read;
    read.bytes = std::move(bytes).value();
    const ForeignFormat* format = saysItIsPacini(read.bytes) ? nullptr : foreignFormatOf(extension, read.bytes);
    if (format == nullptr)
    {
        auto clip = clipOf(read.bytes);
        if (!clip)
            return clip.error();
        read.clip = std::move(clip).value();
        read.format = read.bytes.starts_with("PACB") ? "packed" : "json";
        return read;
    }
    auto imported = format->read(read.bytes);
    if (!imported)
        return imported.error();
    read.clip = std::move(imported->clip);
    read.warnings = std::move(imported->warnings);
    read.format = format->name;
    std::error_code ignored;
    if (const auto second = exportPath(path, format->companion);
        !format->companion.empty() && std::filesystem::is_regular_file(second, ignored))
        if (auto added = addCompanion(second, *format, read); !added)
            return added.error();
    if (read.clip.name.empty())
        read.clip.name = path.stem().string();
    return read;
}

std::filesystem::path exportPath(const std::filesystem::path& main, std::string_view suffix)
{
    std::filesystem::path name = main.stem();
    name += suffix;
    name += main.extension();
    return main.parent_path() / name;
}

std::filesystem::path companionOf(const std::filesystem::path& path)
{
    const std::string extension = lowerExtensionOf(path);
    const std::string stem = path.stem().string();
    for (const ForeignFormat& format : foreignFormats())
    {
        if (format.companion.empty() || format.extension != extension || !stem.ends_with(format.companion))
            continue;
        std::filesystem::path main = path.parent_path() / stem.substr(0, stem.size() - format.companion.size());
        main += path.extension();
        std::error_code ignored;
        if (std::filesystem::is_regular_file(main, ignored))
            return main;
    }
    return {};
}

std::vector<std::string> anyClipExtensions()
{
    std::vector<std::string> extensions{".json", ".pacb"};
    for (const ForeignFormat& format : foreignFormats())
        if (format.read != nullptr)
            extensions.emplace_back(format.extension);
    return extensions;
}

} // namespace pacini
