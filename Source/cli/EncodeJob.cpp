#include "cli/EncodeJob.h"

#include "cli/ReadingAdvice.h"
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
} // namespace

EncodeJob::EncodeJob(const EncodeSettings& wanted) : settings(wanted), encoder(wanted) {}

Result<EncodeResult> EncodeJob::run(const fs::path& input, const fs::path& output, Replaceable replaceable,
                                    const Progress& progress)
{
    const bool makesClip = methodInfo(settings.method).output == MethodOutput::clip;
    EncodeResult result;
    // What others' formats hold is only known when it is made.
    Result<Existing> existing = Existing::replace;
    if (!makesClip)
        existing = mayReplace(output, signalOrigin(input, output), replaceable);
    else if (settings.format->isOwn())
        existing = lookAt(input, output, replaceable, result);
    if (!existing)
        return existing.error();
    if (result.upToDate)
        return result;

    auto reader = AudioReader::open(input, settings.reading);
    if (!reader)
        return withAdvice(reader.error(), true);
    if (settings.dryRun)
        return result;
    Stopwatch work;
    const auto written = makesClip
                             ? encodeClip(*reader, input, output, *existing, replaceable, progress, work, result)
                             : encodeSignal(*reader, input, output, *existing, replaceable, progress, work, result);
    if (!written)
        return written.error();
    result.bytes = *written;
    result.seconds = work.seconds();
    result.replacedSamples = reader->replacedSamples();
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

Result<std::size_t> EncodeJob::encodeClip(AudioReader& reader, const fs::path& input, const fs::path& output,
                                          Existing existing, Replaceable replaceable, const Progress& progress,
                                          Stopwatch& work, EncodeResult& result)
{
    auto clip = encoder.clipOf(reader, input, progress, work);
    if (!clip)
        return withAdvice(clip.error(), true);
    result.duration = clip->duration;
    result.breakpoints = breakpointCount(*clip);
    result.transients = clip->transients.size();
    if (!settings.format->isOwn())
        return writeForeign(*clip, output, replaceable, work, result);
    const auto written = writeClip(output, std::move(*clip), *settings.format, existing);
    return written ? written : atOutput(output, written.error());
}

Result<std::size_t> EncodeJob::writeForeign(const Clip& clip, const fs::path& output, Replaceable replaceable,
                                            Stopwatch& work, EncodeResult& result) const
{
    std::optional<Result<ExportedClip>> exported;
    work.run([&] { exported = settings.format->write(clip, settings.exporting); });
    if (!*exported)
        return exported->error();
    const auto allowed = mayReplace(output, **exported, replaceable);
    if (!allowed)
        return allowed.error();
    const auto written = writeExport(output, **exported, *allowed);
    if (!written)
        return atOutput(output, written.error());
    result.stray = strayCompanion(output, *settings.format, **exported);
    std::size_t bytes = 0;
    for (const ExportedFile& file : (*exported)->files)
        bytes += file.bytes.size();
    return bytes;
}

FileOrigin EncodeJob::signalOrigin(const fs::path& input, const fs::path& output) const
{
    Fingerprint method;
    method.add(methodInfo(settings.method).name);
    return originOf(input, output, method.text());
}

Result<std::size_t> EncodeJob::encodeSignal(AudioReader& reader, const fs::path& input, const fs::path& output,
                                            Existing existing, Replaceable replaceable, const Progress& progress,
                                            Stopwatch& work, EncodeResult& result) const
{
    SoundFileParts file(reader, progress);
    const auto signal = encoder.signalOf({reader.sampleRate(), reader.channels()}, file, work);
    if (!signal)
        return withAdvice(signal.error(), true);
    result.duration = static_cast<double>(signal->size()) / reader.sampleRate();
    AudioWriteParams writing;
    writing.sampleRate = reader.sampleRate();
    if (replaceable != Replaceable::named)
        writing.origin = signalOrigin(input, output);
    writing.existing = existing;
    const auto report = writeAudio(output, *signal, writing);
    if (!report)
        return atOutput(output, report.error());
    return static_cast<std::size_t>(report->bytes);
}

std::vector<EncoderParameter> EncodeJob::expectedRecord(const Clip& clip) const
{
    if (settings.method == Method::a2vt)
        return encoderRecord(settings.params);
    // A method's record depends on its choices and the sample rate, not on the sound: an empty one will do.
    auto record = translateToClip(settings.method, {}, clip.source.sampleRate, settings.choices).encoder;
    std::erase_if(record, dependsOnSound);
    return record;
}

Result<Existing> EncodeJob::lookAt(const fs::path& input, const fs::path& output, Replaceable replaceable,
                                   EncodeResult& result) const
{
    if (!isOccupied(output))
        return replaceable == Replaceable::own ? Existing::keep : Existing::replace;
    const ClipFormat* there = ownFormatOf(output);
    if (there == nullptr)
        return replaceable == Replaceable::own ? Result<Existing>(notReplaced(output, "exists and is no clip"))
                                               : Existing::replace;
    const auto read = readClip(output);
    const Clip* clip = read ? &read->clip : nullptr;
    const ClipSeal seal = clip != nullptr ? sealOf(*clip) : ClipSeal::missing;
    const bool mayBeEdited = seal == ClipSeal::missing;
    if (clip && seal != ClipSeal::broken && !(mayBeEdited && replaceable == Replaceable::any) && !settings.force &&
        there == settings.format && isUpToDate(input, output, *clip))
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
        return notReplaced(output, "is no clip as pacini encoded it");
    if (seal == ClipSeal::broken)
        return notReplaced(output, "was edited since it was encoded");
    if (mayBeEdited)
        return notReplaced(output, "exists and may have been edited, since it has no seal of the encoder");
    if (replaceable == Replaceable::own && clip->source.file != sourceNameOf(input))
        return notReplaced(output, "was encoded from " + clip->source.file);
    return Existing::replace;
}

bool EncodeJob::isUpToDate(const fs::path& input, const fs::path& output, const Clip& clip) const
{
    std::error_code error;
    const auto made = fs::last_write_time(output, error);
    if (error || fs::last_write_time(input, error) > made || error)
        return false;
    if (clip.source.file != sourceNameOf(input))
        return false;
    if (clip.source.sampleRate < limits::lowestSampleRate || clip.source.sampleRate > limits::highestSampleRate)
        return false;
    auto record = clip.encoder;
    std::erase_if(record, dependsOnSound);
    return record == expectedRecord(clip);
}

} // namespace pacini::cli
