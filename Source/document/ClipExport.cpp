#include "document/ClipExport.h"

#include "io/AudioWriter.h"
#include "io/ClipFile.h"
#include "io/formats/samples/DriveSamples.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

namespace pacini
{

namespace
{
constexpr int usualRate = 8000; // Hz, where the sound's own is not known

Result<const ClipFormat*> formatOf(const ExportChoice& choice)
{
    for (const ClipFormat& format : exportFormats())
        if (format.name == choice.format)
            return &format;
    return Error{ErrorCode::invalidArgument, "format", "'" + choice.format + "' is not known"};
}

/// Files of one clip that are ready to be written.
struct Prepared
{
    std::string clip;
    std::filesystem::path path;           ///< of the main file
    std::optional<ExportedClip> exported; ///< none: the drive signal, which is made when it is written

    [[nodiscard]] std::vector<std::filesystem::path> files() const
    {
        if (!exported)
            return {path};
        std::vector<std::filesystem::path> all;
        for (const ExportedFile& file : exported->files)
            all.push_back(file.suffix.empty() ? path : exportPath(path, file.suffix));
        return all;
    }
};

Result<Prepared> prepare(const Clip& clip, std::filesystem::path path, const ClipFormat& format,
                         const ExportParams& params)
{
    Prepared made{clip.name, std::move(path), {}};
    if (!format.isWritten())
        return made;
    auto exported = format.write(clip, params);
    if (!exported)
        return exported.error();
    made.exported = std::move(*exported);
    return made;
}

Result<std::vector<std::filesystem::path>> writeRendered(const Clip& clip, const ExportParams& wanted,
                                                         const std::filesystem::path& path, Replaceable replaceable)
{
    const auto existing = mayOverwrite(path, FileOrigin{}, replaceable);
    if (!existing)
        return existing.error();
    AudioWriteParams params;
    params.existing = *existing;
    params.sampleRate = wanted.sampleRate                  ? *wanted.sampleRate
                        : clip.source.sampleRate >= 2000.0 ? static_cast<int>(std::lround(clip.source.sampleRate))
                                                           : usualRate;
    auto samples = driveSignal(clip, params.sampleRate, wanted.profile, wanted.strength);
    if (!samples)
        return samples.error();
    params.expectedFrames = samples->size();
    params.markers = clip.markers;
    if (auto written = writeAudio(path, *samples, params); !written)
        return written.error();
    return std::vector{path};
}

/// With `clip` in front where there are several.
Error ofClip(Error error, const std::string& clip, bool several)
{
    if (several)
        error.where = clip + (error.where.empty() ? "" : ": " + error.where);
    return error;
}

/// The place of each clip: names that several share get numbers.
std::vector<std::filesystem::path> placesOf(const std::vector<std::shared_ptr<const Clip>>& clips,
                                            const ExportChoice& choice, const ClipFormat& format)
{
    std::vector<std::filesystem::path> places;
    std::set<std::string> taken;
    for (const auto& clip : clips)
    {
        auto name = exportName(*clip, format);
        if (clips.size() == 1 && !choice.file.empty())
            name = choice.file.string();
        if (!choice.mark.empty() && name.ends_with(format.extension))
            name.insert(name.size() - format.extension.size(), "-" + choice.mark);
        const auto first = std::filesystem::path(name);
        for (int number = 2; !taken.insert(name).second; ++number)
            name = first.stem().string() + "-" + std::to_string(number).append(format.extension);
        places.push_back(choice.folder / name);
    }
    return places;
}
} // namespace

const std::vector<ClipFormat>& exportFormats()
{
    static const std::vector<ClipFormat> formats = []
    {
        std::vector<ClipFormat> list;
        std::copy_if(clipFormats().begin(), clipFormats().end(), std::back_inserter(list),
                     [](const ClipFormat& format) { return format.isWritten(); });
        list.insert(
            list.begin() + 2,
            {.name = "wav",
             .title = "Drive signal (WAV)",
             .extension = ".wav",
             .keeps = "Drive signal samples for the chosen actuator, within its limits. Cannot be edited further.",
             .isSamples = true});
        return list;
    }();
    return formats;
}

std::string exportName(const Clip& clip, const ClipFormat& format)
{
    std::string name;
    for (const char c : clip.name)
        name += static_cast<unsigned char>(c) < 32 || std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos
                    ? '_'
                    : c;
    while (!name.empty() && (name.front() == '.' || name.front() == ' '))
        name.erase(name.begin());
    if (name.empty())
        name = "clip";
    return name.append(format.extension == ".wav" ? ".haptic" : "").append(format.extension);
}

std::vector<ExportChoice> choicesFor(const ExportChoice& first, const std::vector<std::string>& further)
{
    std::vector<ExportChoice> choices{first};
    std::set<std::string> names{first.format}, extensions;
    if (const auto known = formatOf(first))
        extensions.emplace((*known)->extension);
    for (const std::string& name : further)
    {
        ExportChoice choice = first;
        choice.format = name;
        const auto format = formatOf(choice);
        if (!format || !names.insert(name).second)
            continue;
        choice.params.events = ExportParams().events;
        if (!(*format)->isSamples)
            choice.params.sampleRate = ExportParams().sampleRate;
        if (!choice.file.empty())
            choice.file = choice.file.stem().string().append((*format)->extension);
        if (!extensions.emplace((*format)->extension).second)
            choice.mark = name;
        choices.push_back(std::move(choice));
    }
    return choices;
}

Result<std::vector<FormatLoss>> exportLosses(const Clip& clip, const ExportChoice& choice)
{
    const auto format = formatOf(choice);
    if (!format)
        return format.error();
    if (!(*format)->isWritten()) // the drive signal
        return std::vector<FormatLoss>{};
    auto exported = (*format)->write(clip, choice.params);
    if (!exported)
        return exported.error();
    return std::move(exported->losses);
}

Result<std::vector<StandingFile>> filesInTheWay(const std::vector<std::shared_ptr<const Clip>>& clips,
                                                const ExportChoice& choice)
{
    const auto format = formatOf(choice);
    if (!format)
        return format.error();
    const auto places = placesOf(clips, choice, **format);
    std::vector<std::filesystem::path> all;
    for (std::size_t i = 0; i < clips.size(); ++i)
    {
        const auto made = prepare(*clips[i], places[i], **format, choice.params);
        if (!made)
            return ofClip(made.error(), clips[i]->name, clips.size() > 1);
        const auto files = made->files();
        all.insert(all.end(), files.begin(), files.end());
    }
    return filesInTheWay(all, choice.needed);
}

Result<std::vector<ExportReport>> exportClips(const std::vector<std::shared_ptr<const Clip>>& clips,
                                              const ExportChoice& choice)
{
    const auto format = formatOf(choice);
    if (!format)
        return format.error();
    const auto places = placesOf(clips, choice, **format);
    std::vector<ExportReport> reports;
    for (std::size_t i = 0; i < clips.size(); ++i)
    {
        const auto write = [&]() -> Result<ExportReport>
        {
            auto made = prepare(*clips[i], places[i], **format, choice.params);
            if (!made)
                return made.error();
            if (const auto others = filesInTheWay(made->files(), choice.needed); !others)
                return others.error();
            if (!made->exported)
            {
                auto files = writeRendered(*clips[i], choice.params, made->path, choice.replaceable);
                if (!files)
                    return files.error();
                return ExportReport{made->clip, std::move(*files), {}};
            }
            const auto existing = mayOverwrite(made->path, *made->exported, choice.replaceable);
            if (!existing)
                return existing.error();
            auto files = writeExport(made->path, *made->exported, *existing);
            if (!files)
                return files.error();
            return ExportReport{made->clip, std::move(*files), std::move(made->exported->losses)};
        };
        auto report = write();
        if (!report)
            return ofClip(report.error(), clips[i]->name, clips.size() > 1);
        reports.push_back(std::move(*report));
    }
    return reports;
}

} // namespace pacini
