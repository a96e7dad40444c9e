#include "cli/RenderJob.h"

#include "cli/ProfileInput.h"
#include "cli/Task.h"
#include "io/AudioReader.h"
#include "io/FileExtension.h"
#include "io/Fingerprint.h"
#include "io/Stopwatch.h"
#include "io/formats/json/ClipJson.h"

#include <pacini/actuator/ProtectionParams.h>
#include <pacini/foundation/LargestMagnitude.h>
#include <pacini/synthesis/RenderScene.h>
#include <pacini/synthesis/Transparency.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

namespace pacini::cli
{

namespace
{
/// Whether `output` was made so, and is still as it was made; then `result` tells its size.
bool isUpToDate(const std::filesystem::path& output, const FileOrigin& origin, RenderResult& result)
{
    if (!isOccupied(output) || readOrigin(output) != origin || !isAsMade(output))
        return false;
    AudioReadOptions anyRate;
    anyRate.lowestSampleRate = limits::lowestWrittenRate;
    const auto sound = AudioReader::open(output, anyRate);
    std::error_code unknown;
    result.bytes = std::filesystem::file_size(output, unknown);
    if (!sound || !sound->frames() || unknown)
        return false;
    result.duration = static_cast<double>(*sound->frames()) / sound->sampleRate();
    result.upToDate = true;
    return true;
}

/// The sound file that a rendering becomes.
class RenderedFile : public RenderSink
{
public:
    /// `format` is all that is known before the rendering begins.
    RenderedFile(const std::filesystem::path& file, const AudioWriteParams& wanted,
                 const std::function<void(double)>& toTell)
        : output(file), format(wanted), told(toTell)
    {
    }

    Result<void> begin(const RenderPlan& plan, std::uint64_t frames) override
    {
        isMotor = plan.motor;
        format.channels = static_cast<int>(plan.actuators);
        format.expectedFrames = frames;
        return timed(
            [&]() -> Result<void>
            {
                auto created = AudioWriter::create(output, format);
                if (!created)
                    return atOutput(output, created.error());
                writer.emplace(std::move(*created));
                return {};
            });
    }

    Result<void> take(const RenderBlock& block) override
    {
        for (const std::span<const float> channel : block.channels)
            peak = std::max(peak, static_cast<double>(largestMagnitude(channel)));
        const auto frames = interleavedFrames(block);
        return timed(
            [&]() -> Result<void>
            {
                if (auto written = writer->write(frames); !written)
                    return atOutput(output, written.error());
                return {};
            });
    }

    Result<void> progress(double share) override
    {
        told(share);
        return {};
    }

    [[nodiscard]] Result<AudioWriteReport> finish()
    {
        auto report = writer->finish();
        return report ? report : atOutput(output, report.error());
    }

    bool isMotor = false;
    double peak = 0.0;
    Stopwatch access; ///< to the file

private:
    /// One channel as it is. Valid until the next call, as the block is.
    std::span<const float> interleavedFrames(const RenderBlock& block)
    {
        const std::size_t width = block.channels.size();
        if (width == 1)
            return block.channels.front();
        interleaved.resize(block.frames() * width);
        for (std::size_t a = 0; a < width; ++a)
            for (std::size_t n = 0; n < block.frames(); ++n)
                interleaved[n * width + a] = block.channels[a][n];
        return interleaved;
    }

    template <typename Work>
    Result<void> timed(Work&& work)
    {
        Result<void> done;
        access.run([&] { done = work(); });
        return done;
    }

    const std::filesystem::path& output;
    AudioWriteParams format;
    const std::function<void(double)>& told;
    std::optional<AudioWriter> writer;
    std::vector<float> interleaved;
};

/// The input and the planned output.
struct RenderInput
{
    Scene scene;
    FileOrigin origin;
    Existing existing = Existing::replace;
};

/// The markers of a clip at the times that they have in its rendering.
std::vector<Marker> renderedMarkers(const Clip& clip, const RenderParams& params)
{
    std::vector<Marker> markers;
    for (const Marker& marker : clip.markers)
    {
        const double time = params.adjustment.delay + params.adjustment.stretch * marker.time;
        if (time >= params.from && time <= params.to.value_or(time))
            markers.push_back({time - params.from, marker.name});
    }
    return markers;
}

/// Reads `input` and finds out whether anything is to be done: nothing where the output is up to date, as `result` says
/// then.
Result<RenderInput> readInput(const std::filesystem::path& input, const std::filesystem::path& output,
                              Replaceable replaceable, const RenderSettings& settings, RenderResult& result)
{
    auto read = readClipOrScene(input, settings.reading);
    if (!read)
        return read.error();
    result.isScene = std::holds_alternative<Scene>(read->content);
    result.warnings = std::move(read->warnings);
    RenderInput found;
    found.scene =
        result.isScene ? std::get<Scene>(std::move(read->content)) : sceneOf(std::get<Clip>(std::move(read->content)));
    Fingerprint substance; // changes when the output would
    substance.add(settings.record);
    substance.add(read->bytes);
    if (result.isScene)
        for (const Clip& clip : found.scene.clips)
            substance.add(writeClipJson(clip));
    found.origin = originOf(input, output, substance.text());
    if (settings.resume && replaceable != Replaceable::named && isUpToDate(output, found.origin, result))
        return found;
    const auto existing = mayReplace(output, found.origin, replaceable);
    if (!existing)
        return existing.error();
    if (replaceable == Replaceable::named && !result.isScene && !isStream(input))
    {
        std::error_code unknown; // no recording when one of them is missing
        const std::string& recording = found.scene.clips.front().source.file;
        if (!recording.empty() && std::filesystem::equivalent(input.parent_path() / recording, output, unknown))
            return notReplaced(output, "is the recording of this clip");
    }
    found.existing = *existing;
    return found;
}
} // namespace

Result<RenderResult> render(const std::filesystem::path& input, const std::filesystem::path& output,
                            Replaceable replaceable, const RenderSettings& settings,
                            const std::function<void(double)>& progress)
{
    RenderResult result;
    auto found = readInput(input, output, replaceable, settings, result);
    if (!found)
        return found.error();
    if (result.upToDate || settings.dryRun)
        return result;

    AudioWriteParams format;
    format.sampleRate = static_cast<int>(std::lround(settings.compile.sampleRate));
    format.encoding = settings.encoding;
    if (replaceable != Replaceable::named) // so that equal signals in named files are equal to the byte
        format.origin = found->origin;
    format.existing = found->existing;
    if (!result.isScene)
        format.markers = renderedMarkers(found->scene.clips.front(), settings);
    if (!format.markers.empty() && lowerExtension(output) == ".flac")
        result.warnings.emplace_back("has markers, which FLAC does not get; render a .wav to keep them");
    RenderedFile file(output, format, progress);
    const Profile* profile = settings.profile ? &*settings.profile : nullptr;
    Stopwatch work;
    std::vector<Adaptation> made;
    if (settings.designedFor)
    {
        std::optional<Result<TransparentScene>> alike;
        const AdaptationParams& params = settings.compile.adaptation;
        work.run([&] { alike = transparentScene(std::move(found->scene), *settings.designedFor, *profile, params); });
        if (!*alike)
            return ofProfileOption(alike->error());
        found->scene = std::move((*alike)->scene);
        made = std::move((*alike)->changes);
        for (const auto& [where, what] : (*alike)->lost)
            result.warnings.push_back(found->scene.clips.size() > 1 ? where + ": " + what : what);
    }
    std::optional<Result<RenderReport>> rendered;
    work.run([&] { rendered = renderScene(std::move(found->scene), profile, settings, file); });
    work.leaveOut(file.access);
    if (!*rendered)
    {
        Error error = rendered->error();
        if (error.code == ErrorCode::tooLarge && error.where.empty())
            error.message += "; reduce --stretch or --delay";
        return error;
    }
    static_cast<RenderReport&>(result) = std::move(**rendered);
    result.adaptations.insert(result.adaptations.begin(), made.begin(), made.end());
    for (const LeftOut& item : result.leftOut)
        if (item.unplayable && item.isWholePlay())
            result.warnings.push_back(fmt::format("{} {}, so it is left out", item.where, item.reason));
    const auto written = file.finish();
    if (!written)
        return written.error();
    if (profile != nullptr)
        result.protection = settings.protect ? protectionText(*profile, file.isMotor)
                                             : "is off: the limits of the profile are not enforced";
    result.duration = static_cast<double>(result.frames) / settings.compile.sampleRate;
    result.seconds = work.seconds();
    result.peak = file.peak;
    result.bytes = written->bytes;
    result.clippedSamples = written->clippedSamples;
    return result;
}

} // namespace pacini::cli
