#include "io/AnyClip.h"

#include "io/ClipFile.h"
#include "io/ClipJson.h"
#include "io/InputFile.h"
#include "io/SceneFile.h"
#include "io/formats/ImportedClip.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <system_error>
#include <utility>

namespace pacini
{

namespace
{
// Haptics Studio writes NAME.continuous.ahap and NAME.transients.ahap, for two players.
constexpr std::string_view studioContinuous = ".continuous";
constexpr std::string_view studioTransients = ".transients";

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
    lengthen(clip, more->clip.duration);
    std::vector<Transient> events;
    std::merge(clip.transients.begin(), clip.transients.end(), more->clip.transients.begin(),
               more->clip.transients.end(), std::back_inserter(events),
               [](const Transient& a, const Transient& b) { return a.time < b.time; });
    clip.transients = std::move(events);
    std::move(more->warnings.begin(), more->warnings.end(), std::back_inserter(read.warnings));
    return {};
}
/// The companion of a main file, in Pacini's or in Haptics Studio's way of naming them, if there is one.
std::filesystem::path companionFile(const std::filesystem::path& main, const ForeignFormat& format)
{
    if (format.companion.empty())
        return {};
    std::vector<std::filesystem::path> names{exportPath(main, format.companion)};
    if (const std::string stem = main.stem().string(); stem.ends_with(studioContinuous))
    {
        const std::string name = stem.substr(0, stem.size() - studioContinuous.size());
        names.push_back(main.parent_path() / (name + std::string(studioTransients) + main.extension().string()));
    }
    std::error_code ignored;
    for (const auto& name : names)
        if (std::filesystem::is_regular_file(name, ignored))
            return name;
    return {};
}

Result<std::string> readBytes(const std::filesystem::path& path)
{
    return isForeignExtension(lowerExtensionOf(path)) ? readWholeFile(path, largestClipText) : readClipBytes(path);
}

Result<AnyClip> clipIn(const std::filesystem::path& path, std::string bytes, bool strict)
{
    AnyClip read;
    read.bytes = std::move(bytes);
    const ForeignFormat* format =
        saysItIsPacini(read.bytes) ? nullptr : foreignFormatOf(lowerExtensionOf(path), read.bytes);
    if (format == nullptr)
    {
        ReadWarnings warnings(strict);
        auto clip = clipOf(read.bytes, &warnings);
        if (!clip)
            return clip.error();
        read.clip = std::move(clip).value();
        read.format = read.bytes.starts_with("PACB") ? "packed" : "json";
        read.warnings = warnings.texts();
        return read;
    }
    auto imported = format->read(read.bytes);
    if (!imported)
        return imported.error();
    read.clip = std::move(imported->clip);
    read.warnings = std::move(imported->warnings);
    read.format = format->name;
    if (const auto second = companionFile(path, *format); !second.empty())
        if (auto added = addCompanion(second, *format, read); !added)
            return added.error();
    if (read.clip.name.empty())
        read.clip.name = path.stem().string();
    return read;
}
} // namespace

Result<AnyClip> readAnyClip(const std::filesystem::path& path, bool strict)
{
    auto bytes = readBytes(path);
    if (!bytes)
        return bytes.error();
    if (isSceneText(*bytes))
        return Error{ErrorCode::invalidData, "", "is a scene, and a clip is needed; 'pacini render' plays scenes"};
    return clipIn(path, std::move(bytes).value(), strict);
}

Result<ClipOrScene> readClipOrScene(const std::filesystem::path& path, const AnyReadParams& params)
{
    auto bytes = readBytes(path);
    if (!bytes)
        return bytes.error();
    if (isSceneText(*bytes))
    {
        ReadWarnings warnings(params.strict);
        auto scene = sceneOfText(*bytes, params.clipFolder.empty() ? path.parent_path() : params.clipFolder, &warnings);
        if (!scene)
            return scene.error();
        return ClipOrScene{std::move(scene).value(), "scene", warnings.texts(), std::move(bytes).value()};
    }
    auto clip = clipIn(path, std::move(bytes).value(), params.strict);
    if (!clip)
        return clip.error();
    return ClipOrScene{std::move(clip->clip), std::move(clip->format), std::move(clip->warnings),
                       std::move(clip->bytes)};
}

bool looksLikeClip(const std::filesystem::path& path)
{
    return isForeignExtension(lowerExtensionOf(path)) || clipFormatOf(path).has_value();
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
        if (format.companion.empty() || format.extension != extension)
            continue;
        for (const auto& [suffix, mainSuffix] : {std::pair<std::string_view, std::string_view>(format.companion, ""),
                                                 std::pair(studioTransients, studioContinuous)})
        {
            if (!stem.ends_with(suffix))
                continue;
            std::filesystem::path main = path.parent_path() / stem.substr(0, stem.size() - suffix.size());
            main += mainSuffix;
            main += path.extension();
            std::error_code ignored;
            if (std::filesystem::is_regular_file(main, ignored))
                return main;
        }
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
