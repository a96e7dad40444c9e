#include "document/ExportBatch.h"

#include "io/AudioWriter.h"
#include "io/ClipExport.h"
#include "io/formats/PlayedClip.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace pacini
{

namespace
{
constexpr int usualRate = 8000; // Hz, where the sound's own is not known

const ExportFormat* formatNamed(std::string_view name)
{
    for (const ExportFormat& format : exportFormats())
        if (format.name == name)
            return &format;
    return nullptr;
}

int rateOf(const Clip& clip, const ExportChoice& choice)
{
    if (choice.sampleRate)
        return *choice.sampleRate;
    return clip.source.sampleRate >= 2000.0 ? static_cast<int>(std::lround(clip.source.sampleRate)) : usualRate;
}

std::optional<Profile> profileOf(const ExportChoice& choice)
{
    return choice.profile ? std::optional(*choice.profile) : std::nullopt;
}

Result<ExportedClip> exportedAs(const Clip& clip, const ExportChoice& choice)
{
    const ClipTarget* target = clipTargetNamed(choice.format);
    if (target == nullptr)
        return Error{ErrorCode::invalidArgument, "format", "'" + choice.format + "' is not known"};
    ExportParams params;
    params.profile = profileOf(choice);
    params.sampleRate = choice.sampleRate;
    return pacini::exportClip(clip, *target, params);
}

Result<void> writeRendered(const Clip& clip, const ExportChoice& choice, const std::filesystem::path& path)
{
    AudioWriteParams params;
    params.sampleRate = rateOf(clip, choice);
    auto samples = driveSignal(clip, params.sampleRate, profileOf(choice));
    if (!samples)
        return samples.error();
    params.expectedFrames = samples->size();
    if (auto written = writeAudio(path, *samples, params); !written)
        return written.error();
    return {};
}
} // namespace

const std::vector<ExportFormat>& exportFormats()
{
    static const std::vector<ExportFormat> formats = []
    {
        std::vector<ExportFormat> list;
        for (const ClipTarget& target : clipTargets())
        {
            if (target.foreign != nullptr)
                list.push_back({std::string(target.name), std::string(target.foreign->title),
                                std::string(target.extension), target.name == "pcm"});
            else
                list.push_back({std::string(target.name),
                                target.name == "json" ? "Pacini clip (JSON)" : "Pacini clip (packed)",
                                std::string(target.extension), false});
        }
        list.insert(list.begin() + 2, {"wav", "Drive signal (WAV)", ".wav", true});
        return list;
    }();
    return formats;
}

std::string_view whatIsKept(std::string_view format)
{
    if (format == "json")
        return "Keeps everything: curves, events, noise, markers, source.";
    if (format == "packed")
        return "Keeps everything on the grids of the clip's quantiser, in a small file.";
    if (format == "wav")
        return "Samples of the drive signal for the chosen actuator, its limits kept. It cannot be edited further.";
    return "A format of other programs. What this clip loses in it is listed below.";
}

std::string exportName(const Clip& clip, const ExportFormat& format)
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
    return name + (format.extension == ".wav" ? ".haptic" : "") + format.extension;
}

Result<std::vector<FormatLoss>> exportLosses(const Clip& clip, const ExportChoice& choice)
{
    if (choice.format == "wav")
        return std::vector<FormatLoss>{};
    auto exported = exportedAs(clip, choice);
    if (!exported)
        return exported.error();
    return std::move(exported->losses);
}

Result<std::vector<ExportReport>> exportClips(const std::vector<std::shared_ptr<const Clip>>& clips,
                                              const ExportChoice& choice)
{
    const ExportFormat* format = formatNamed(choice.format);
    if (format == nullptr)
        return Error{ErrorCode::invalidArgument, "format", "'" + choice.format + "' is not known"};
    std::vector<ExportReport> reports;
    std::set<std::string> taken;
    for (const auto& clip : clips)
    {
        auto name = exportName(*clip, *format);
        if (clips.size() == 1 && !choice.file.empty())
            name = choice.file.string();
        const auto first = std::filesystem::path(name);
        for (int number = 2; !taken.insert(name).second; ++number)
            name = first.stem().string() + "-" + std::to_string(number) + format->extension;
        const auto path = choice.folder / name;
        const auto failed = [&](Error error)
        {
            if (clips.size() > 1)
                error.where = clip->name + (error.where.empty() ? "" : ": " + error.where);
            return error;
        };
        ExportReport report{clip->name, {}, {}};
        if (format->name == "wav")
        {
            if (auto written = writeRendered(*clip, choice, path); !written)
                return failed(written.error());
            report.files.push_back(path);
        }
        else
        {
            auto exported = exportedAs(*clip, choice);
            if (!exported)
                return failed(exported.error());
            auto written = writeExport(path, *exported);
            if (!written)
                return failed(written.error());
            for (const WrittenFile& file : *written)
                report.files.push_back(file.path);
            report.losses = std::move(exported->losses);
        }
        reports.push_back(std::move(report));
    }
    return reports;
}

} // namespace pacini
