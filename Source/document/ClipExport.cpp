#include "document/ClipExport.h"

#include "io/AudioWriter.h"
#include "io/ClipFile.h"
#include "io/formats/samples/DriveSamples.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

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

Result<void> writeRendered(const Clip& clip, const ExportParams& wanted, const std::filesystem::path& path)
{
    AudioWriteParams params;
    params.sampleRate = wanted.sampleRate                  ? *wanted.sampleRate
                        : clip.source.sampleRate >= 2000.0 ? static_cast<int>(std::lround(clip.source.sampleRate))
                                                           : usualRate;
    auto samples = driveSignal(clip, params.sampleRate, wanted.profile, wanted.strength);
    if (!samples)
        return samples.error();
    params.expectedFrames = samples->size();
    if (auto written = writeAudio(path, *samples, params); !written)
        return written.error();
    return {};
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

Result<std::vector<ExportReport>> exportClips(const std::vector<std::shared_ptr<const Clip>>& clips,
                                              const ExportChoice& choice)
{
    const auto found = formatOf(choice);
    if (!found)
        return found.error();
    const ClipFormat& format = **found;
    std::vector<ExportReport> reports;
    std::set<std::string> taken;
    for (const auto& clip : clips)
    {
        auto name = exportName(*clip, format);
        if (clips.size() == 1 && !choice.file.empty())
            name = choice.file.string();
        const auto first = std::filesystem::path(name);
        for (int number = 2; !taken.insert(name).second; ++number)
            name = first.stem().string() + "-" + std::to_string(number).append(format.extension);
        const auto path = choice.folder / name;
        const auto failed = [&](Error error)
        {
            if (clips.size() > 1)
                error.where = clip->name + (error.where.empty() ? "" : ": " + error.where);
            return error;
        };
        ExportReport report{clip->name, {}, {}};
        if (!format.isWritten())
        {
            if (auto written = writeRendered(*clip, choice.params, path); !written)
                return failed(written.error());
            report.files.push_back(path);
        }
        else
        {
            auto exported = format.write(*clip, choice.params);
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
