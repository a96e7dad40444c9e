#include "cli/EncodeJob.h"

#include "cli/Task.h"
#include "io/AtomicFile.h"
#include "io/AudioWriter.h"
#include "io/ClipFile.h"

#include <pacini/analysis/MonoMix.h>

#include <algorithm>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

namespace pacini::cli
{

namespace fs = std::filesystem;

namespace
{
/// Hands visit() the next samples until the file ends. Errors: those of AudioReader, tooLarge beyond 24 hours.
template <typename Visit>
Result<void> forEachPiece(AudioReader& reader, const std::function<void(double)>& progress, Visit&& visit)
{
    const auto channels = static_cast<std::size_t>(reader.channels());
    const double expected = static_cast<double>(reader.frames().value_or(0));
    std::vector<float> buffer(channels * std::max<std::size_t>(1, 65536 / channels));
    std::uint64_t frames = 0;
    for (;;)
    {
        const auto got = reader.read(buffer);
        if (!got)
            return got.error();
        if (*got == 0)
            return {};
        frames += *got;
        if (static_cast<double>(frames) / reader.sampleRate() > limits::duration)
            return Error{ErrorCode::tooLarge, "", "is longer than 24 hours; cut it into parts"};
        visit(std::span<const float>(buffer).first(*got * channels));
        if (expected > 0.0)
            progress(static_cast<double>(frames) / expected);
    }
}

Result<std::vector<float>> readMono(AudioReader& reader, const std::function<void(double)>& progress, Stopwatch& work)
{
    std::vector<float> samples;
    const auto read = forEachPiece(reader, progress,
                                   [&samples](std::span<const float> piece)
                                   { samples.insert(samples.end(), piece.begin(), piece.end()); });
    if (!read)
        return read.error();
    work.run([&] { samples = monoMix(samples, static_cast<std::size_t>(reader.channels())); });
    return samples;
}

/// Encoder parameters that follow from the sound.
bool dependsOnSound(const EncoderParameter& parameter)
{
    return parameter.name == "gain" || parameter.name == "channelGain";
}
} // namespace

EncodeJob::EncodeJob(const EncodeSettings& wanted) : settings(wanted), encoder(wanted.params) {}

Result<EncodeResult> EncodeJob::run(const fs::path& input, const fs::path& output, const Progress& progress)
{
    const bool makesClip = methodInfo(settings.method).output == MethodOutput::clip;
    EncodeResult result;
    if (makesClip && !settings.force && isUpToDate(input, output, result))
        return result;

    auto reader = AudioReader::open(input, settings.reading);
    if (!reader)
        return reader.error();
    Stopwatch work;
    const auto written = makesClip ? encodeClip(*reader, input, output, progress, work, result)
                                   : encodeSignal(*reader, output, progress, work, result);
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
        return reader.error();
    Stopwatch work;
    return makeClip(*reader, input, progress, work);
}

Result<std::size_t> EncodeJob::encodeClip(AudioReader& reader, const fs::path& input, const fs::path& output,
                                          const Progress& progress, Stopwatch& work, EncodeResult& result)
{
    auto made = makeClip(reader, input, progress, work);
    if (!made)
        return made.error();
    // Both formats hold the same data: what lies on the grids of `quantise` bits.
    std::vector<std::byte> packed;
    work.run([&] { packed = packClip(*made, packParamsFor(*made)); });
    const Clip clip = unpackClip(packed).value();
    result.duration = clip.duration;
    result.breakpoints = breakpointCount(clip);
    result.transients = clip.transients.size();
    if (settings.target.name == "packed")
    {
        auto written = writeFileAtomically(output, packed);
        return written ? written : atOutput(output, written.error());
    }
    std::optional<Result<ExportedClip>> exported;
    work.run([&] { exported = exportClip(clip, settings.target, settings.exporting); });
    if (!*exported)
        return exported->error();
    const auto written = writeExport(output, **exported);
    if (!written)
        return atOutput(output, written.error());
    std::size_t bytes = 0;
    for (const WrittenFile& file : *written)
        bytes += file.bytes;
    return bytes;
}

Result<std::size_t> EncodeJob::encodeSignal(AudioReader& reader, const fs::path& output, const Progress& progress,
                                            Stopwatch& work, EncodeResult& result) const
{
    const auto mono = readMono(reader, progress, work);
    if (!mono)
        return mono.error();
    std::vector<float> signal;
    work.run([&] { signal = translateToSignal(settings.method, *mono, reader.sampleRate()); });
    result.duration = static_cast<double>(signal.size()) / reader.sampleRate();
    const auto report = writeAudio(output, signal, {.sampleRate = reader.sampleRate()});
    if (!report)
        return atOutput(output, report.error());
    return static_cast<std::size_t>(report->bytes);
}

Result<Clip> EncodeJob::makeClip(AudioReader& reader, const fs::path& input, const Progress& progress, Stopwatch& work)
{
    Clip clip;
    if (settings.method == Method::a2vt)
    {
        auto encoded = encodeInPieces(reader, progress, work);
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
    clip.source.file = input.filename().string();
    clip.name = input.stem().string();
    return clip;
}

Result<Clip> EncodeJob::encodeInPieces(AudioReader& reader, const Progress& progress, Stopwatch& work)
{
    work.run([&] { encoder.start(reader.sampleRate(), reader.channels(), reader.frames().value_or(0)); });
    const auto read =
        forEachPiece(reader, progress, [&](std::span<const float> piece) { work.run([&] { encoder.push(piece); }); });
    if (!read)
        return read.error();
    Clip clip;
    work.run([&] { clip = encoder.finish(); });
    return clip;
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

bool EncodeJob::isUpToDate(const fs::path& input, const fs::path& output, EncodeResult& result) const
{
    std::error_code error;
    const auto made = fs::last_write_time(output, error);
    if (error || fs::last_write_time(input, error) > made || error)
        return false;
    const auto format = settings.target.name == "packed" ? ClipFormat::packed : ClipFormat::json;
    if (settings.target.foreign != nullptr || clipFormatOf(output) != format)
        return false;
    const auto clip = readClip(output);
    if (!clip || clip->source.file != input.filename().string())
        return false;
    if (clip->source.sampleRate < limits::lowestSampleRate || clip->source.sampleRate > limits::highestSampleRate)
        return false;
    auto record = clip->encoder;
    std::erase_if(record, dependsOnSound);
    if (record != expectedRecord(*clip))
        return false;
    result.upToDate = true;
    result.bytes = static_cast<std::size_t>(fs::file_size(output, error));
    result.duration = clip->duration;
    result.breakpoints = breakpointCount(*clip);
    result.transients = clip->transients.size();
    return true;
}

} // namespace pacini::cli
