#include "document/ExportBatch.h"

#include "io/AudioWriter.h"
#include "io/ClipFile.h"
#include "io/formats/samples/DriveSamples.h"

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
    const ClipFormat* target = clipFormatNamed(choice.format);
    if (target == nullptr || !target->isWritten())
        return Error{ErrorCode::invalidArgument, "format", "'" + choice.format + "' is not known"};
    ExportParams params;
    params.profile = profileOf(choice);
    params.sampleRate = choice.sampleRate;
    return target->write(clip, params);
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
        for (const ClipFormat& format : clipFormats())
            if (format.isWritten())
                list.push_back({std::string(format.name), std::string(format.title), std::string(format.extension),
                                format.isSamples});
        list.insert(list.begin() + 2, {"wav", "Drive signal (WAV)", ".wav", true});
        return list;
    }();
    return formats;
}

std::string_view whatIsKept(std::string_view format)
{
    const ClipFormat* known = clipFormatNamed(format);
    return known != nullptr
               ? known->keeps
               : "Samples of the drive signal for the chosen actuator, its limits kept. It cannot be edited further.";
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
            report.files = std::move(written).value();
            report.losses = std::move(exported->losses);
        }
        reports.push_back(std::move(report));
    }
    return reports;
}

} // namespace pacini
