#include "cli/RenderJob.h"

#include "cli/Stopwatch.h"
#include "cli/Task.h"
#include "io/ClipFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace pacini::cli
{

DecoderParams decoderParamsFor(const Clip& clip, const RenderSettings& settings)
{
    DecoderParams params = settings.decoder;
    if (encoderText(clip, "method", "a2vt") == "thesis")
    {
        const DecoderParams thesis =
            thesisDecoderParams(params.sampleRate, settings.profile ? settings.profile->resonance.frequency : 67.0);
        params.carriers = thesis.carriers;
        params.followEnvelope = thesis.followEnvelope;
        params.fullRate = thesis.fullRate;
        params.pulses = thesis.pulses;
    }
    params.carriers = settings.carriers.value_or(params.carriers);
    params.followEnvelope = settings.followEnvelope.value_or(params.followEnvelope);
    params.pulses.shape = settings.pulseShape.value_or(params.pulses.shape);
    if (settings.pulseShape)
    {
        params.pulses.cycles = settings.pulseCycles;
        params.pulses.frequency =
            settings.pulseFrequency.value_or(settings.profile ? settings.profile->resonance.frequency : 67.0);
    }
    return params;
}

Result<RenderResult> render(const std::filesystem::path& input, const std::filesystem::path& output,
                            const RenderSettings& settings, const std::function<void(double)>& progress)
{
    const auto clip = readClip(input);
    if (!clip)
        return clip.error();

    const double fs = settings.decoder.sampleRate;
    RenderResult result;
    Stopwatch work;
    std::unique_ptr<Decoder> decoder;
    work.run([&] { decoder = std::make_unique<Decoder>(*clip, decoderParamsFor(*clip, settings)); });
    result.report = decoder->report();
    const auto total = static_cast<std::uint64_t>(decoder->totalFrames());
    result.duration = static_cast<double>(total) / fs;
    if (result.duration > limits::duration)
        return Error{ErrorCode::tooLarge, "",
                     fmt::format("would last {:.1f} hours, at most 24 are written; make --stretch or --delay smaller",
                                 result.duration / 3600.0)};

    constexpr std::size_t blockFrames = 4096;
    Equalizer equalizer;
    if (settings.profile)
    {
        equalizer.prepare({fs, blockFrames});
        equalizer.setParams(settings.profile->equalizer);
    }
    AudioWriteParams format;
    format.sampleRate = static_cast<int>(std::lround(fs));
    format.encoding = settings.encoding;
    format.expectedFrames = total;
    auto writer = AudioWriter::create(output, format);
    if (!writer)
        return atOutput(output, writer.error());
    std::vector<float> block(blockFrames);
    for (std::uint64_t done = 0; done < total;)
    {
        const auto part =
            std::span(block).first(static_cast<std::size_t>(std::min<std::uint64_t>(blockFrames, total - done)));
        work.run(
            [&]
            {
                decoder->process(part);
                if (settings.profile)
                    equalizer.process(part, part);
            });
        for (const float v : part)
            result.peak = std::max(result.peak, std::abs(static_cast<double>(v)));
        if (auto written = writer->write(part); !written)
            return atOutput(output, written.error());
        done += part.size();
        progress(static_cast<double>(done) / static_cast<double>(total));
    }
    const auto report = writer->finish();
    if (!report)
        return atOutput(output, report.error());
    result.bytes = report->bytes;
    result.clippedSamples = report->clippedSamples;
    result.seconds = work.seconds();
    return result;
}

} // namespace pacini::cli
