#include "cli/EncodeJob.h"

#include "cli/ReadingAdvice.h"
#include "cli/Task.h"
#include "io/AudioWriter.h"
#include "io/ClipFile.h"
#include "io/ClipSeal.h"
#include "io/Fingerprint.h"
#include "io/Utf8.h"

#include <pacini/analysis/EncodeSound.h>
#include <pacini/analysis/MonoMix.h>
#include <pacini/analysis/SoundSurvey.h>

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
/// Reads a sound part by part. Errors: those of AudioReader, tooLarge beyond 24 hours.
class SoundFile
{
public:
    SoundFile(AudioReader& opened, const std::function<void(double)>& toTell)
        : reader(opened),
          progress(toTell),
          expected(static_cast<double>(opened.frames().value_or(0))),
          buffer(soundPartLength(static_cast<std::size_t>(opened.channels())))
    {
    }

    [[nodiscard]] SoundPart operator()()
    {
        if (expected > 0.0 && frames > 0)
            progress(static_cast<double>(frames) / expected);
        const auto got = reader.read(buffer);
        if (!got)
            return withAdvice(got.error(), true);
        frames += *got;
        if (static_cast<double>(frames) / reader.sampleRate() > limits::duration)
            return Error{ErrorCode::tooLarge, "", "is longer than 24 hours; cut it into parts"};
        return std::span<const float>(buffer).first(*got * static_cast<std::size_t>(reader.channels()));
    }

private:
    AudioReader& reader;
    const std::function<void(double)>& progress;
    double expected;
    std::vector<float> buffer;
    std::uint64_t frames = 0;
};

/// Hands visit() all parts of a sound. Errors: those of SoundFile.
template <typename Visit>
Result<void> forEachPart(SoundFile file, Visit&& visit)
{
    for (;;)
    {
        const SoundPart part = file();
        if (!part)
            return part.error();
        if (part->empty())
            return {};
        visit(*part);
    }
}

Result<std::vector<float>> readMono(AudioReader& reader, const std::function<void(double)>& progress, Stopwatch& work)
{
    std::vector<float> samples;
    const auto read = forEachPart(SoundFile(reader, progress), [&samples](std::span<const float> part)
                                  { samples.insert(samples.end(), part.begin(), part.end()); });
    if (!read)
        return read.error();
    work.run([&] { samples = monoMix(samples, static_cast<std::size_t>(reader.channels())); });
    return samples;
}

/// Sounds that are worth being read twice, so that what is found in them need not be kept.
bool isLong(const AudioReader& reader)
{
    constexpr double seconds = 1200.0;
    return static_cast<double>(reader.frames().value_or(0)) > seconds * reader.sampleRate();
}

/// How much of the time of encoding a long sound its survey takes.
double shareOfSurvey(const EncoderParams& params)
{
    return params.audible > 0.0 ? 0.4 : 0.2;
}

/// Encoder parameters that follow from the sound.
bool dependsOnSound(const EncoderParameter& parameter)
{
    return parameter.name == "gain" || parameter.name == "channelGain" || parameter.name == clipSealName;
}

/// What a clip calls its sound; nothing when that came from standard input.
std::string sourceName(const fs::path& input)
{
    return input == "-" ? std::string() : wellFormedUtf8(input.filename().string());
}
} // namespace

EncodeJob::EncodeJob(const EncodeSettings& wanted) : settings(wanted), encoder(wanted.params) {}

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
    return makeClip(*reader, input, progress, work);
}

Result<std::size_t> EncodeJob::encodeClip(AudioReader& reader, const fs::path& input, const fs::path& output,
                                          Existing existing, Replaceable replaceable, const Progress& progress,
                                          Stopwatch& work, EncodeResult& result)
{
    auto made = makeClip(reader, input, progress, work);
    if (!made)
        return made.error();
    // Both of Pacini's formats hold the same: what lies on the grids of `quantise` bits.
    Clip clip;
    work.run(
        [&]
        {
            clip = onGrids(std::move(*made));
            sealClip(clip);
        });
    result.duration = clip.duration;
    result.breakpoints = breakpointCount(clip);
    result.transients = clip.transients.size();
    if (!settings.format->isOwn())
        return writeForeign(clip, output, replaceable, work, result);
    const auto written = writeClip(output, std::move(clip), *settings.format, existing);
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
    const auto mono = readMono(reader, progress, work);
    if (!mono)
        return mono.error();
    std::vector<float> signal;
    work.run([&] { signal = translateToSignal(settings.method, *mono, reader.sampleRate()); });
    result.duration = static_cast<double>(signal.size()) / reader.sampleRate();
    AudioWriteParams writing;
    writing.sampleRate = reader.sampleRate();
    if (replaceable != Replaceable::named)
        writing.origin = signalOrigin(input, output);
    writing.existing = existing;
    const auto report = writeAudio(output, signal, writing);
    if (!report)
        return atOutput(output, report.error());
    return static_cast<std::size_t>(report->bytes);
}

Result<Clip> EncodeJob::makeClip(AudioReader& reader, const fs::path& input, const Progress& progress, Stopwatch& work)
{
    Clip clip;
    if (settings.method == Method::a2vt)
    {
        auto encoded = encodeInPieces(reader, input, progress, work);
        if (!encoded)
            return encoded.error();
        clip = std::move(encoded).value();
    }
    else
    {
        const auto mono = readMono(reader, progress, work);
        if (!mono)
            return mono.error();
        work.run([&] { clip = translateToClip(settings.method, *mono, reader.sampleRate(), settings.choices); });
        clip.source.sampleRate = reader.sampleRate();
        clip.source.channels = reader.channels();
    }
    clip.source.file = sourceName(input);
    clip.name = clip.source.file.empty() ? "stdin" : wellFormedUtf8(input.stem().string());
    return clip;
}

Result<Clip> EncodeJob::encodeInPieces(AudioReader& reader, const fs::path& input, const Progress& progress,
                                       Stopwatch& work)
{
    std::optional<SoundScale> scale;
    double done = 0.0;
    if (isLong(reader) && !isStream(input))
    {
        done = shareOfSurvey(settings.params);
        const auto found = survey(
            input, [&](double part) { progress(done * part); }, work);
        if (!found)
            return found.error();
        scale = *found;
    }
    const std::function<void(double)> rest = [&](double part)
    {
        progress(done + (1.0 - done) * part);
    };
    SoundFile file(reader, rest);
    Stopwatch reading;
    Result<Clip> clip = Clip();
    work.run(
        [&]
        {
            const auto next = [&]
            {
                SoundPart part = std::span<const float>();
                reading.run([&] { part = file(); });
                return part;
            };
            clip = encodePrecisely(encoder,
                                   {reader.sampleRate(), reader.channels(), reader.frames().value_or(0), scale}, next);
        });
    work.leaveOut(reading);
    return clip;
}

Result<SoundScale> EncodeJob::survey(const fs::path& input, const Progress& progress, Stopwatch& work) const
{
    auto reader = AudioReader::open(input, settings.reading);
    if (!reader)
        return withAdvice(reader.error(), true);
    SoundSurvey whole(settings.params);
    whole.start(reader->sampleRate(), reader->channels());
    const auto read = forEachPart(SoundFile(*reader, progress),
                                  [&](std::span<const float> part) { work.run([&] { whole.push(part); }); });
    if (!read)
        return read.error();
    SoundScale found;
    work.run([&] { found = whole.finish(); });
    return found;
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
    if (replaceable == Replaceable::own && clip->source.file != sourceName(input))
        return notReplaced(output, "was encoded from " + clip->source.file);
    return Existing::replace;
}

bool EncodeJob::isUpToDate(const fs::path& input, const fs::path& output, const Clip& clip) const
{
    std::error_code error;
    const auto made = fs::last_write_time(output, error);
    if (error || fs::last_write_time(input, error) > made || error)
        return false;
    if (clip.source.file != sourceName(input))
        return false;
    if (clip.source.sampleRate < limits::lowestSampleRate || clip.source.sampleRate > limits::highestSampleRate)
        return false;
    auto record = clip.encoder;
    std::erase_if(record, dependsOnSound);
    return record == expectedRecord(clip);
}

} // namespace pacini::cli
