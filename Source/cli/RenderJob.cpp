#include "cli/RenderJob.h"

#include "cli/Task.h"
#include "io/AudioReader.h"
#include "io/Fingerprint.h"
#include "io/Stopwatch.h"
#include "io/formats/json/ClipJson.h"

#include <pacini/synthesis/SignalPlayer.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

namespace pacini::cli
{

namespace
{
constexpr std::size_t blockFrames = 4096;

/// One buffer for each actuator.
class Channels
{
public:
    explicit Channels(std::size_t count) : samples(count, std::vector<float>(blockFrames)), spans(count) {}

    [[nodiscard]] std::span<const std::span<float>> first(std::size_t frames)
    {
        for (std::size_t a = 0; a < samples.size(); ++a)
            spans[a] = std::span(samples[a]).first(frames);
        return spans;
    }
    [[nodiscard]] std::size_t count() const { return samples.size(); }
    [[nodiscard]] const std::vector<float>& operator[](std::size_t a) const { return samples[a]; }

private:
    std::vector<std::vector<float>> samples;
    std::vector<std::span<float>> spans;
};

/// Energies of a signal and of its difference from another, over all channels.
struct ErrorMeter
{
    double wanted = 0.0, difference = 0.0;

    void add(const Channels& reference, const Channels& found, std::size_t frames)
    {
        for (std::size_t a = 0; a < reference.count(); ++a)
            for (std::size_t n = 0; n < frames; ++n)
            {
                const auto x = static_cast<double>(reference[a][n]);
                const double d = static_cast<double>(found[a][n]) - x;
                wanted += x * x;
                difference += d * d;
            }
    }
    [[nodiscard]] double decibels() const
    {
        return difference > 0.0 ? 10.0 * std::log10(difference / wanted) : -std::numeric_limits<double>::infinity();
    }
};

/// What each play is called: by itself or by its clip.
std::vector<std::string> playNames(const Scene& scene)
{
    std::vector<std::string> names;
    for (const ScenePlay& play : scene.plays)
        names.push_back(play.name.empty() ? scene.clips[play.clip].name : play.name);
    return names;
}

std::vector<PlayReport> describe(const std::vector<DecodedPlay>& plays, const std::vector<std::string>& names)
{
    std::vector<PlayReport> reports;
    for (const DecodedPlay& decoded : plays)
        reports.push_back({decoded.play, names[decoded.play], decoded.start, decoded.duration, decoded.decoder});
    return reports;
}

/// 16 digits that change when the output would: with the bytes of the input, a scene's clips and the settings.
std::string substanceOf(std::string_view bytes, const Scene& scene, bool isScene, const RenderSettings& settings)
{
    Fingerprint all;
    all.add(settings.record);
    all.add(bytes);
    if (isScene)
        for (const Clip& clip : scene.clips)
            all.add(writeClipJson(clip));
    return all.text();
}

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

/// Whether `output` is the recording beside the clip `input` that it says it was made from.
bool isRecordingOf(const Clip& clip, const std::filesystem::path& input, const std::filesystem::path& output)
{
    std::error_code unknown; // false when one of them is missing
    return !clip.source.file.empty() && !isStream(input) &&
           std::filesystem::equivalent(input.parent_path() / clip.source.file, output, unknown);
}
} // namespace

Result<RenderResult> render(const std::filesystem::path& input, const std::filesystem::path& output,
                            Replaceable replaceable, const RenderSettings& settings,
                            const std::function<void(double)>& progress)
{
    auto read = readClipOrScene(input, settings.reading);
    if (!read)
        return read.error();
    RenderResult result;
    result.isScene = std::holds_alternative<Scene>(read->content);
    result.warnings = std::move(read->warnings);
    Scene scene =
        result.isScene ? std::get<Scene>(std::move(read->content)) : sceneOf(std::get<Clip>(std::move(read->content)));

    const FileOrigin origin = originOf(input, output, substanceOf(read->bytes, scene, result.isScene, settings));
    if (settings.resume && replaceable != Replaceable::named && isUpToDate(output, origin, result))
        return result;
    const auto existing = mayReplace(output, origin, replaceable);
    if (!existing)
        return existing.error();
    if (replaceable == Replaceable::named && !result.isScene && isRecordingOf(scene.clips.front(), input, output))
        return notReplaced(output, "is the recording that this clip was made from");
    if (settings.dryRun)
        return result;

    const double fs = settings.compile.sampleRate;
    Stopwatch work;
    double length = 0.0; // s
    std::optional<Result<RenderPlan>> compiled;
    const Profile* profile = settings.profile ? &*settings.profile : nullptr;
    work.run(
        [&]
        {
            scene = adjusted(std::move(scene), settings.adjustment);
            length = result.isScene
                         ? scene.duration
                         : scene.plays.front().start + scene.clips.front().duration * settings.adjustment.stretch;
            if (length <= limits::duration)
                compiled = compilePlan(scene, profile, settings.compile);
        });
    if (!compiled)
        return Error{ErrorCode::tooLarge, "",
                     fmt::format("would last {:.1f} hours, at most 24 are written; make --stretch or --delay smaller",
                                 length / 3600.0)};
    if (!*compiled)
        return compiled->error();
    RenderPlan& plan = **compiled;
    result.actuators = plan.actuators;
    result.givenPlays = scene.plays.size();
    result.keptPlays = plan.plays.size();
    result.predictedError = plan.predictedError;
    result.leftOut = std::move(plan.leftOut);
    result.adaptations = std::move(plan.adaptations);
    if (profile != nullptr)
        result.protection =
            settings.protect ? protectionText(*profile, plan.motor) : "is off: no limit of the profile is kept";
    std::vector<std::string> names;
    if (settings.describe)
        names = playNames(scene);

    ScenePlayerParams playing;
    playing.sampleRate = fs;
    playing.protect = settings.protect;
    std::unique_ptr<SignalPlayer> whole; // plays everything, to compare with
    if (settings.measure)
    {
        CompileParams all = settings.compile;
        all.leaveOut = false;
        auto planned = compilePlan(scene, profile, all);
        if (!planned)
            return planned.error();
        whole = std::make_unique<SignalPlayer>(std::move(*planned), playing, settings.felt);
    }
    scene = {};
    std::unique_ptr<SignalPlayer> player;
    work.run([&] { player = std::make_unique<SignalPlayer>(std::move(plan), playing, settings.felt); });
    // A part is played from the start like the whole, so that it is equal to that part of the whole.
    const auto total = static_cast<std::uint64_t>(player->totalFrames());
    const auto first = static_cast<std::uint64_t>(std::llround(settings.from * fs));
    const auto last =
        settings.to ? std::min(total, static_cast<std::uint64_t>(std::llround(*settings.to * fs))) : total;
    if (first >= last && (first > 0 || last < total))
        return Error{ErrorCode::invalidArgument, "",
                     fmt::format("has nothing from {} s on{}; it lasts {:.3f} s", settings.from,
                                 settings.to ? fmt::format(" to {} s", *settings.to) : "",
                                 static_cast<double>(total) / fs)};
    result.duration = static_cast<double>(last - first) / fs;

    AudioWriteParams format;
    format.sampleRate = static_cast<int>(std::lround(fs));
    format.channels = static_cast<int>(result.actuators);
    format.encoding = settings.encoding;
    format.expectedFrames = last - first;
    if (replaceable != Replaceable::named) // so that equal signals in named files are equal to the byte
        format.origin = origin;
    format.existing = *existing;
    auto writer = AudioWriter::create(output, format);
    if (!writer)
        return atOutput(output, writer.error());
    Channels block(result.actuators), wholeBlock(result.actuators);
    std::vector<float> interleaved(blockFrames * result.actuators);
    ErrorMeter error;
    for (std::uint64_t done = 0; done < last;)
    {
        // Blocks end where the part starts.
        const std::uint64_t until = done < first ? first : last;
        const auto frames = static_cast<std::size_t>(std::min<std::uint64_t>(blockFrames, until - done));
        work.run([&] { player->process(block.first(frames)); });
        if (whole)
        {
            whole->process(wholeBlock.first(frames));
            if (done >= first)
                error.add(wholeBlock, block, frames);
        }
        done += frames;
        progress(static_cast<double>(done) / static_cast<double>(last));
        if (done <= first)
            continue;
        const auto part = std::span(interleaved).first(frames * result.actuators);
        for (std::size_t a = 0; a < result.actuators; ++a)
            for (std::size_t n = 0; n < frames; ++n)
            {
                part[n * result.actuators + a] = block[a][n];
                result.peak = std::max(result.peak, std::abs(static_cast<double>(block[a][n])));
            }
        if (auto written = writer->write(part); !written)
            return atOutput(output, written.error());
    }
    if (whole)
        result.measured = error.decibels();
    result.maxSounding = player->maxSounding();
    result.reduction = player->maxReduction();
    if (settings.describe)
        result.plays = describe(player->decodedPlays(), names);
    const auto report = writer->finish();
    if (!report)
        return atOutput(output, report.error());
    result.bytes = report->bytes;
    result.clippedSamples = report->clippedSamples;
    result.seconds = work.seconds();
    return result;
}

} // namespace pacini::cli
