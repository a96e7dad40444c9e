#include "cli/EncodeJob.h"

#include "cli/Stopwatch.h"
#include "cli/Task.h"
#include "io/AtomicFile.h"

#include <algorithm>
#include <system_error>
#include <vector>

namespace pacini::cli
{

namespace fs = std::filesystem;

EncodeJob::EncodeJob(const EncodeSettings& wanted) : settings(wanted), encoder(wanted.params) {}

Result<EncodeResult> EncodeJob::run(const fs::path& input, const fs::path& output,
                                    const std::function<void(double)>& progress)
{
    EncodeResult result;
    if (!settings.force && isUpToDate(input, output, result))
        return result;

    auto reader = AudioReader::open(input, settings.reading);
    if (!reader)
        return reader.error();
    const auto channels = static_cast<std::size_t>(reader->channels());
    const double expected = static_cast<double>(reader->frames().value_or(0));

    Stopwatch work;
    work.run([&] { encoder.start(reader->sampleRate(), reader->channels()); });
    std::vector<float> buffer(channels * std::max<std::size_t>(1, 65536 / channels));
    std::uint64_t frames = 0;
    for (;;)
    {
        const auto got = reader->read(buffer);
        if (!got)
            return got.error();
        if (*got == 0)
            break;
        frames += *got;
        if (static_cast<double>(frames) / reader->sampleRate() > limits::duration)
            return Error{ErrorCode::tooLarge, "", "is longer than 24 hours; cut it into parts"};
        work.run([&] { encoder.push(std::span(buffer).first(*got * channels)); });
        if (expected > 0.0)
            progress(static_cast<double>(frames) / expected);
    }

    Clip clip;
    work.run([&] { clip = encoder.finish(); });
    clip.source.file = input.filename().string();
    clip.name = input.stem().string();
    // Both formats hold the same data: what lies on the grids of `quantise` bits.
    std::vector<std::byte> packed;
    work.run([&] { packed = packClip(clip, packParamsFor(clip)); });
    clip = unpackClip(packed).value();
    const auto written = settings.format == ClipFormat::packed ? writeFileAtomically(output, packed)
                                                               : writeClip(output, clip, settings.format);
    if (!written)
        return atOutput(output, written.error());

    result.bytes = *written;
    result.duration = clip.duration;
    result.seconds = work.seconds();
    result.breakpoints = breakpointCount(clip);
    result.transients = clip.transients.size();
    result.replacedSamples = reader->replacedSamples();
    return result;
}

bool EncodeJob::isUpToDate(const fs::path& input, const fs::path& output, EncodeResult& result) const
{
    std::error_code error;
    const auto made = fs::last_write_time(output, error);
    if (error || fs::last_write_time(input, error) > made || error)
        return false;
    const auto clip = readClip(output);
    if (!clip || clip->source.file != input.filename().string())
        return false;
    // The gain depends on the sound; everything else must be as it would be written now.
    for (const EncoderParameter& parameter : encoderRecord(settings.params))
        if (std::find(clip->encoder.begin(), clip->encoder.end(), parameter) == clip->encoder.end())
            return false;
    result.upToDate = true;
    result.bytes = static_cast<std::size_t>(fs::file_size(output, error));
    result.duration = clip->duration;
    result.breakpoints = breakpointCount(*clip);
    result.transients = clip->transients.size();
    return true;
}

} // namespace pacini::cli
