#include "io/ClipFile.h"

#include "io/FileExtension.h"
#include "io/InputFile.h"
#include "io/Overwrite.h"
#include "io/ReadWarnings.h"
#include "io/SceneFile.h"
#include "io/formats/ImportReport.h"
#include "io/formats/json/ClipJson.h"
#include "io/formats/json/JsonFormat.h"
#include "io/formats/packed/PackedFormat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
// Haptics Studio writes NAME.continuous.ahap and NAME.transients.ahap, for two players.
constexpr std::string_view studioContinuous = ".continuous";
constexpr std::string_view studioTransients = ".transients";

bool isBlank(std::string_view bytes)
{
    return bytes.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

/// The first bytes of a file, which tell its format; empty when it cannot be read.
std::string firstBytesOf(const fs::path& path)
{
    const auto file = openForReading(path);
    std::string start(1024, '\0');
    start.resize(file ? std::fread(start.data(), 1, start.size(), file->get()) : 0);
    return start;
}

bool startsAsOwn(std::string_view bytes)
{
    return isPackedClip(bytes) || looksLikeJson(bytes);
}

Error notAClip()
{
    return {ErrorCode::invalidData, "", "is not a clip: neither JSON nor packed; encode audio to get a clip"};
}

Error notRead(const ClipFormat& format)
{
    return {
        ErrorCode::invalidData, "",
        fmt::format("is a file of format {} ({}), which Pacini writes but does not read", format.name, format.title)};
}

/// A file that may be a clip or a scene.
struct FoundFile
{
    std::string bytes;
    const ClipFormat* format = nullptr; ///< as clipFormatOf() finds it
    bool isScene = false;
};

Result<FoundFile> readFile(const fs::path& path)
{
    const std::string extension = lowerExtension(path);
    // A recording of hundreds of megabytes is not read just to find that it is no clip. Pipes can be read only once.
    StartCheck check;
    std::error_code ignored;
    if (!isForeignExtension(extension) && fs::is_regular_file(path, ignored))
        check = [&](std::string_view start) -> std::optional<Error>
        {
            if (isBlank(start) || startsAsOwn(start))
                return std::nullopt;
            const ClipFormat* format = clipFormatOf(extension, start);
            return format != nullptr && !format->isRead() ? notRead(*format) : notAClip();
        };
    auto bytes = readWholeFile(path, largestClipText, check);
    if (!bytes)
        return bytes.error();
    const ClipFormat* format = clipFormatOf(extension, *bytes);
    const bool isScene = isSceneText(*bytes);
    return FoundFile{std::move(*bytes), format, isScene};
}

/// Adds the events of the second file.
Result<void> addCompanion(const fs::path& path, ReadClip& read)
{
    const auto bytes = readWholeFile(path, largestClipText);
    auto more = bytes ? read.format->read(*bytes) : Result<ImportedClip>(bytes.error());
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
fs::path companionFile(const fs::path& main, const ClipFormat& format)
{
    if (format.companion.empty())
        return {};
    std::vector<fs::path> names{exportPath(main, format.companion)};
    if (const std::string stem = main.stem().string(); stem.ends_with(studioContinuous))
    {
        const std::string name = stem.substr(0, stem.size() - studioContinuous.size());
        names.push_back(main.parent_path() / (name + std::string(studioTransients) + main.extension().string()));
    }
    std::error_code ignored;
    for (const auto& name : names)
        if (fs::is_regular_file(name, ignored))
            return name;
    return {};
}

Result<ReadClip> clipIn(const fs::path& path, FoundFile found, bool strict)
{
    auto& [bytes, format, isScene] = found;
    if (format == nullptr && bytes.empty())
        return Error{ErrorCode::invalidData, "", "is empty; choose a file with a clip"};
    if (format == nullptr && !looksLikeJson(bytes))
        return notAClip();
    if (format == nullptr) // whose reader says what is missing
        format = &jsonFormat();
    if (!format->isRead())
        return notRead(*format);
    auto imported = format->read(bytes, strict);
    if (!imported)
        return imported.error();
    ReadClip read{std::move(imported->clip), format, std::move(imported->warnings), std::move(bytes)};
    if (const auto second = companionFile(path, *format); !second.empty())
        if (auto added = addCompanion(second, read); !added)
            return added.error();
    if (!format->isOwn() && read.clip.name.empty())
        read.clip.name = path.stem().string();
    return read;
}
} // namespace

Result<ReadClip> readClip(const fs::path& path, bool strict)
{
    auto found = readFile(path);
    if (!found)
        return found.error();
    if (found->isScene)
        return Error{ErrorCode::invalidData, "", "is a scene, not a clip; 'pacini render' renders scenes"};
    return clipIn(path, std::move(*found), strict);
}

Result<ClipOrScene> readClipOrScene(const fs::path& path, const ClipReadParams& params)
{
    auto found = readFile(path);
    if (!found)
        return found.error();
    if (found->isScene)
    {
        ReadWarnings warnings(params.strict);
        auto scene =
            sceneOfText(found->bytes, params.clipFolder.empty() ? path.parent_path() : params.clipFolder, &warnings);
        if (!scene)
            return scene.error();
        return ClipOrScene{std::move(scene).value(), nullptr, warnings.texts(), std::move(found->bytes)};
    }
    auto clip = clipIn(path, std::move(*found), params.strict);
    if (!clip)
        return clip.error();
    return ClipOrScene{std::move(clip->clip), clip->format, std::move(clip->warnings), std::move(clip->bytes)};
}

bool looksLikeClip(const fs::path& path)
{
    const std::string extension = lowerExtension(path);
    if (isForeignExtension(extension))
        return true;
    const std::string start = firstBytesOf(path);
    const ClipFormat* format = clipFormatOf(extension, start);
    return startsAsOwn(start) || (format != nullptr && !format->isRead());
}

const ClipFormat* ownFormatOf(const fs::path& path)
{
    const ClipFormat* format = clipFormatOf("", firstBytesOf(path));
    return format != nullptr && format->isOwn() ? format : nullptr;
}

std::vector<std::string> clipFileExtensions()
{
    std::vector<std::string> extensions;
    for (const ClipFormat& format : clipFormats())
        if (format.isRead())
            extensions.emplace_back(format.extension);
    return extensions;
}

Result<std::size_t> writeClip(const fs::path& path, Clip clip, const ClipFormat& format, Existing existing)
{
    if (auto valid = validate(clip); !valid)
        return valid.error();
    auto file = AtomicFile::create(path, existing);
    if (!file)
        return file.error();
    std::size_t bytes = 0;
    format.stream(std::move(clip),
                  [&](std::string_view piece)
                  {
                      bytes += piece.size();
                      file->write(std::as_bytes(std::span<const char>(piece)));
                  });
    if (auto done = file->commit(); !done)
        return done.error();
    return bytes;
}

#ifndef PACINI_READERS_ONLY
Result<std::vector<fs::path>> writeExport(const fs::path& main, const ExportedClip& exported, Existing existing)
{
    const auto placeOf = [&main](const ExportedFile& file)
    {
        return file.suffix.empty() ? main : exportPath(main, file.suffix);
    };
    const auto atOther = [&](const ExportedFile& file, Error error)
    {
        const std::string name = placeOf(file).filename().string();
        error.where = file.suffix.empty() ? error.where : name + (error.where.empty() ? "" : ": " + error.where);
        return error;
    };
    // Before the first is written: all of them, or none.
    std::vector<Existing> ways;
    for (const ExportedFile& file : exported.files)
    {
        ways.push_back(existing);
        if (existing == Existing::replace || file.suffix.empty())
            continue;
        const auto way = mayOverwrite(placeOf(file), file.bytes, Replaceable::own);
        if (!way)
            return atOther(file, {way.error().code, "", way.error().message});
        ways.back() = *way;
    }
    std::vector<fs::path> files;
    for (std::size_t i = 0; i < exported.files.size(); ++i)
    {
        const ExportedFile& file = exported.files[i];
        if (const auto written = writeFileAtomically(placeOf(file), file.bytes, ways[i]); !written)
            return atOther(file, written.error());
        files.push_back(placeOf(file));
    }
    return files;
}
#endif

fs::path exportPath(const fs::path& main, std::string_view suffix)
{
    fs::path name = main.stem();
    name += suffix;
    name += main.extension();
    return main.parent_path() / name;
}

fs::path companionOf(const fs::path& path)
{
    const std::string extension = lowerExtension(path);
    const std::string stem = path.stem().string();
    for (const ClipFormat& format : clipFormats())
    {
        if (format.companion.empty() || format.extension != extension)
            continue;
        for (const auto& [suffix, mainSuffix] : {std::pair<std::string_view, std::string_view>(format.companion, ""),
                                                 std::pair(studioTransients, studioContinuous)})
        {
            if (!stem.ends_with(suffix))
                continue;
            fs::path main = path.parent_path() / stem.substr(0, stem.size() - suffix.size());
            main += mainSuffix;
            main += path.extension();
            std::error_code ignored;
            if (fs::is_regular_file(main, ignored))
                return main;
        }
    }
    return {};
}

fs::path strayCompanion(const fs::path& main, const ClipFormat& format, const ExportedClip& exported)
{
    const std::string_view suffix = format.companion;
    const bool written = std::any_of(exported.files.begin(), exported.files.end(),
                                     [&](const ExportedFile& file) { return file.suffix == suffix; });
    if (suffix.empty() || written)
        return {};
    auto stray = exportPath(main, suffix);
    std::error_code ignored;
    return fs::is_regular_file(stray, ignored) ? stray : fs::path();
}

std::string strayWarning(const fs::path& stray)
{
    return stray.filename().string() +
           ": exists already, is not part of this clip, but would be read with it; remove it";
}

} // namespace pacini
