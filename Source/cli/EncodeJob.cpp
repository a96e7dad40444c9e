#include "cli/EncodeJob.h"

#include "cli/ReadingAdvice.h"
#include "cli/SceneFiles.h"
#include "cli/Task.h"
#include "io/AudioWriter.h"
#include "io/ClipFile.h"
#include "io/ClipSeal.h"
#include "io/Fingerprint.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#if defined(_WIN32)
#include <windows.h>
#endif

namespace pacini::cli
{

namespace fs = std::filesystem;

namespace
{
/// Encoder parameters that follow from the sound.
bool dependsOnSound(const EncoderParameter& parameter)
{
    return parameter.name == "gain" || parameter.name == "channelGain" || parameter.name == clipSealName;
}

/// Whether `input` has not been written since `output` was.
bool wasWrittenBefore(const fs::path& input, const fs::path& output)
{
#if defined(_WIN32)
    // libstdc++ tells whole seconds.
    WIN32_FILE_ATTRIBUTE_DATA source{}, result{};
    return GetFileAttributesExW(input.c_str(), GetFileExInfoStandard, &source) != 0 &&
           GetFileAttributesExW(output.c_str(), GetFileExInfoStandard, &result) != 0 &&
           CompareFileTime(&source.ftLastWriteTime, &result.ftLastWriteTime) <= 0;
#else
    std::error_code error;
    const auto made = fs::last_write_time(output, error);
    return !error && fs::last_write_time(input, error) <= made && !error;
#endif
}
} // namespace

EncodeJob::EncodeJob(const EncodeSettings& wanted) : settings(wanted), encoder(wanted) {}

Result<EncodeResult> EncodeJob::run(const fs::path& input, const fs::path& output, Replaceable replaceable,
                                    const Progress& progress)
{
    Target target{output, replaceable, Existing::replace, {}};
    EncodeResult result;
    const bool makesClip = methodInfo(settings.method).output == MethodOutput::clip;
    // What others' formats hold is only known when it is made.
    Result<Existing> existing = Existing::replace;
    if (!makesClip)
    {
        Fingerprint method;
        method.add(methodInfo(settings.method).name);
        target.origin = originOf(input, output, method.text());
        existing = mayReplace(output, target.origin, replaceable);
    }
    else if (settings.shortestScene)
        existing = Existing::keep; // see writeScenes()
    else if (settings.format->isOwn())
        existing = lookAt(input, target, result);
    if (!existing)
        return existing.error();
    if (result.upToDate)
        return result;
    target.existing = *existing;

    auto reader = AudioReader::open(input, settings.reading);
    if (!reader)
        return withAdvice(reader.error(), true);
    if (settings.dryRun)
        return result;
    if (settings.markers)
        reader->addMarkers(*settings.markers);
    Stopwatch work;
    Result<std::size_t> written = std::size_t(0);
    if (makesClip)
    {
        auto clip = encoder.clipOf(*reader, input, progress, work);
        written = clip ? write(std::move(*clip), target, work, result) : withAdvice(clip.error(), true);
    }
    else
    {
        SoundFileParts parts(*reader, progress);
        const auto signal = encoder.signalOf({reader->sampleRate(), reader->channels()}, parts, work);
        written = signal ? write(*signal, reader->sampleRate(), target, result) : withAdvice(signal.error(), true);
    }
    if (!written)
        return written.error();
    result.bytes = *written;
    result.seconds = work.seconds();
    result.replacedSamples = reader->replacedSamples();
    result.warnings = reader->warnings();
    return result;
}

Result<Clip> EncodeJob::encode(const fs::path& input, const Progress& progress)
{
    auto reader = AudioReader::open(input, settings.reading);
    if (!reader)
        return withAdvice(reader.error(), true);
    Stopwatch work;
    auto clip = encoder.clipOf(*reader, input, progress, work);
    return clip ? clip : withAdvice(clip.error(), true);
}

Result<std::size_t> EncodeJob::write(Clip clip, const Target& target, Stopwatch& work, EncodeResult& result) const
{
    result.duration = clip.duration;
    result.breakpoints = breakpointCount(clip);
    result.transients = clip.transients.size();
    if (settings.shortestScene)
    {
        std::optional<Result<SceneFiles>> files;
        work.run(
            [&] {
                files = sceneFiles(clip, target.output, *settings.shortestScene, *settings.format, settings.exporting);
            });
        if (!*files)
            return files->error();
        result.scenes = (*files)->scenes;
        return writeSceneFiles(**files, target.replaceable);
    }
    if (settings.format->isOwn())
    {
        const auto written = writeClip(target.output, std::move(clip), *settings.format, target.existing);
        return written ? written : atOutput(target.output, written.error());
    }
    std::optional<Result<ExportedClip>> exported;
    work.run([&] { exported = settings.format->write(clip, settings.exporting); });
    if (!*exported)
        return exported->error();
    if (const auto fits = checkStream(target.output, **exported); !fits)
        return fits.error();
    const auto allowed = mayReplace(target.output, **exported, target.replaceable);
    if (!allowed)
        return allowed.error();
    const auto written = writeExport(target.output, **exported, *allowed);
    if (!written)
        return atOutput(target.output, written.error());
    result.stray = strayCompanion(target.output, *settings.format, **exported);
    std::size_t bytes = 0;
    for (const ExportedFile& file : (*exported)->files)
        bytes += file.bytes.size();
    return bytes;
}

Result<std::size_t> EncodeJob::write(std::span<const float> signal, int sampleRate, const Target& target,
                                     EncodeResult& result) const
{
    result.duration = static_cast<double>(signal.size()) / sampleRate;
    AudioWriteParams writing;
    writing.sampleRate = sampleRate;
    if (target.replaceable != Replaceable::named)
        writing.origin = target.origin;
    writing.existing = target.existing;
    const auto report = writeAudio(target.output, signal, writing);
    if (!report)
        return atOutput(target.output, report.error());
    return static_cast<std::size_t>(report->bytes);
}

std::vector<EncoderParameter> EncodeJob::expectedRecord(const Clip& clip, const Path& input) const
{
    auto record = methodRecord(clip);
    // Only the sound itself says which of its channels are special. Of up to two none is.
    double lowFrequencyGain = 1.0;
    if (clip.source.channels > 2)
        if (const auto reader = AudioReader::open(input, settings.reading))
            lowFrequencyGain = reader->lowFrequencyGain();
    const auto reading = readingRecord(settings.reading, lowFrequencyGain);
    record.insert(record.end(), reading.begin(), reading.end());
    return record;
}

std::vector<EncoderParameter> EncodeJob::methodRecord(const Clip& clip) const
{
    if (settings.method == Method::a2vt)
        return encoderRecord(settings.params);
    // A method's record depends on its choices and the sample rate, not on the sound: an empty one will do.
    auto record = translateToClip(settings.method, {}, clip.source.sampleRate, settings.choices).encoder;
    std::erase_if(record, dependsOnSound);
    return record;
}

Result<Existing> EncodeJob::lookAt(const fs::path& input, const Target& target, EncodeResult& result) const
{
    const fs::path& output = target.output;
    const Replaceable replaceable = target.replaceable;
    if (!isOccupied(output))
        return replaceable == Replaceable::own ? Existing::keep : Existing::replace;
    const std::string source = sourceNameOf(input);
    const ClipFormat* there = ownFormatOf(output);
    if (there == nullptr)
        return replaceable == Replaceable::own ? Result<Existing>(notReplaced(output, "exists and is not a clip"))
                                               : Existing::replace;
    const auto read = readClip(output);
    const Clip* clip = read ? &read->clip : nullptr;
    const ClipSeal seal = clip != nullptr ? sealOf(*clip) : ClipSeal::missing;
    const bool mayBeEdited = seal == ClipSeal::missing;
    if (clip && seal != ClipSeal::broken && !(mayBeEdited && replaceable == Replaceable::any) && !settings.force &&
        !settings.markers && there == settings.format && wasWrittenBefore(input, output) &&
        clip->source.file == source && isMadeSo(*clip, input))
    {
        std::error_code ignored;
        result.upToDate = true;
        result.bytes = static_cast<std::size_t>(fs::file_size(output, ignored));
        result.duration = clip->duration;
        result.breakpoints = breakpointCount(*clip);
        result.transients = clip->transients.size();
        return Existing::replace;
    }
    if (replaceable == Replaceable::any)
        return Existing::replace;
    if (!clip)
        return notReplaced(output, "is not a clip that pacini encoded");
    if (seal == ClipSeal::broken)
        return notReplaced(output, "was edited since it was encoded");
    if (mayBeEdited)
        return notReplaced(output, "exists without the seal of the encoder and may have been edited");
    if (replaceable == Replaceable::own && clip->source.file != source)
        return notReplaced(output, "was encoded from " + clip->source.file);
    return Existing::replace;
}

bool EncodeJob::isMadeSo(const Clip& clip, const Path& input) const
{
    if (clip.source.sampleRate < limits::lowestSampleRate || clip.source.sampleRate > limits::highestSampleRate)
        return false;
    auto record = clip.encoder;
    std::erase_if(record, dependsOnSound);
    return record == expectedRecord(clip, input);
}

} // namespace pacini::cli
