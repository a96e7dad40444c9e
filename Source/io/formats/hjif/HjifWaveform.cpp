#include "io/formats/hjif/HjifWaveform.h"

#include "io/formats/hjif/HjifWavelet.h"

#include <pacini/analysis/Encoder.h>
#include <pacini/filters/Resampler.h>
#include <pacini/foundation/SizeInMemory.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::size_t maxSamples = std::size_t(1) << 25; // of all channels: more than an hour at 8 kHz
constexpr std::size_t maxResampled = 8;                  // bands: their filters can be long
constexpr double lowestRate = 100.0;                     // Hz

void scale(Curve& curve, double factor)
{
    for (Breakpoint& point : curve)
        point.value = std::min(factor * point.value, limits::amplitude);
}

/// Takes back the gain that an encoder has put on.
void undoGain(Clip& clip)
{
    double gain = 1.0;
    for (auto& [name, value] : clip.encoder)
        if (name == "gain")
            gain = std::get<double>(std::exchange(value, 1.0));
    scale(clip.envelope, 1.0 / gain);
    for (Band& band : clip.bands)
        scale(band.amplitude, 1.0 / gain);
    for (Transient& event : clip.transients)
        event.amplitude = std::min(event.amplitude / gain, limits::amplitude);
}
} // namespace

std::span<float> HjifWaveform::room(std::size_t first, std::size_t count, ImportReport& report,
                                    const std::string& where)
{
    std::vector<float>& samples = channels.back();
    const std::size_t end = first + count;
    if (end > samples.size())
    {
        if (end > maxSamples || drawn + end - samples.size() > maxSamples)
        {
            report.fail(where, fmt::format("makes the waveforms longer than {} samples", maxSamples),
                        ErrorCode::tooLarge);
            return {};
        }
        drawn += end - samples.size();
        samples.resize(end);
    }
    return std::span(samples).subspan(first, count);
}

void HjifWaveform::addWavelet(const HjifBand& band, std::span<const HjifPlaced> blocks, double ticks,
                              ImportReport& report, const std::string& where)
{
    const double rate = band.high;
    if (!(rate >= lowestRate && rate <= highestResamplerRate && rate == std::floor(rate)))
        return report.fail(where + ".upper_frequency_limit",
                           fmt::format("is the sample rate of a WaveletWave band: a whole number of {} to {} Hz",
                                       lowestRate, highestResamplerRate));
    if (!band.blockLength)
        return report.fail(where + ".block_length", "is missing");
    const auto size = *band.blockLength >= 1.0 ? hjifBlockSize(*band.blockLength, ticks, rate) : std::nullopt;
    if (!size)
        return report.fail(where + ".block_length",
                           fmt::format("must be a power of two of {} to {} samples in ticks, not {}", hjifSmallestBlock,
                                       hjifLargestBlock, *band.blockLength));
    if (blocks.size() > maxSamples / *size)
        return report.fail(where, fmt::format("makes the waveforms longer than {} samples", maxSamples),
                           ErrorCode::tooLarge);
    std::vector<float> samples(blocks.size() * *size);
    bool moved = false;
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
        const auto& [effect, position] = blocks[i];
        if (!effect->stream)
            return report.fail(fmt::format("{}.effects[{}].wavelet_stream", where, i), "is missing");
        const auto block = hjifBlockSamples(*effect->stream, *size);
        if (!block)
            return report.fail(fmt::format("{}.effects[{}].wavelet_stream", where, i),
                               "has characters other than letters, digits, '+' and '/'");
        std::transform(block->begin(), block->end(), samples.begin() + static_cast<std::ptrdiff_t>(i * *size),
                       [](double x) { return static_cast<float>(x); });
        moved = moved || std::abs(position - static_cast<double>(i) * *band.blockLength) > 0.5 * *band.blockLength;
    }
    if (moved)
        report.warn(where, "blocks with gaps between them are played end to end, as the reference player does");
    if (static_cast<int>(rate) != fs)
    {
        if (++resampled > maxResampled)
            return report.fail(where, fmt::format("is one of more than {} bands of other sample rates", maxResampled),
                               ErrorCode::tooLarge);
        const Resampler<float> resampler(static_cast<int>(rate), fs);
        if (resampler.outputFrames(samples.size()) > maxSamples)
            return report.fail(where, fmt::format("makes the waveforms longer than {} samples", maxSamples),
                               ErrorCode::tooLarge);
        std::vector<float> slower = std::exchange(samples, std::vector<float>(resampler.outputFrames(samples.size())));
        resampler.process(slower, 0, 0, samples);
    }
    const std::span<float> sum = room(0, samples.size(), report, where);
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += samples[i];
}

void HjifWaveform::addCurve(const HjifBand& band, std::span<const HjifPlaced> waves, double ticks, ImportReport& report,
                            const std::string& where)
{
    const bool straight = band.curve == "Linear";
    for (const auto& [effect, position] : waves)
    {
        const auto& keyframes = effect->keyframes;
        for (std::size_t k = 1; k < keyframes.size() && !report.error; ++k)
        {
            const double from = (position + keyframes[k - 1].position) / ticks * fs;
            const double to = (position + keyframes[k].position) / ticks * fs;
            const double y0 = keyframes[k - 1].amplitude.value_or(0.0), y1 = keyframes[k].amplitude.value_or(0.0);
            const std::size_t first = sizeInMemory(std::ceil(from));
            const std::size_t end = sizeInMemory(std::ceil(to));
            const std::span<float> sum = room(first, end - first, report, where);
            for (std::size_t i = 0; i < sum.size(); ++i)
            {
                const double place = (static_cast<double>(first + i) - from) / (to - from);
                const double risen = straight ? place : place * place * (3.0 - 2.0 * place);
                sum[i] += static_cast<float>(y0 + (y1 - y0) * risen);
            }
        }
    }
}

void HjifWaveform::endBand()
{
    for (float& sample : channels.back())
        sample = std::clamp(sample, -1.0f, 1.0f);
}

void HjifWaveform::scale(double level)
{
    const auto most = static_cast<float>(limits::amplitude);
    for (float& sample : channels.back())
        sample = std::clamp(static_cast<float>(static_cast<double>(sample) * level), -most, most);
}

Clip HjifWaveform::translated(double duration)
{
    std::size_t frames = 0;
    for (const auto& channel : channels)
        frames = std::max(frames, channel.size());
    if (duration > 0.0 && duration * fs < static_cast<double>(frames))
        frames = static_cast<std::size_t>(std::llround(duration * fs));
    constexpr std::size_t maxChannels = 64; // of the encoder
    const std::size_t count = std::min(channels.size(), maxChannels);
    EncoderParams params; // normalising: how weak a curve may be is judged by the loudest
    params.audible = 0.0; // it is felt already
    Encoder encoder(params);
    encoder.start(fs, static_cast<int>(count));
    constexpr std::size_t chunk = 4096;
    std::vector<float> interleaved;
    for (std::size_t at = 0; at < frames; at += chunk)
    {
        const std::size_t now = std::min(chunk, frames - at);
        interleaved.assign(now * count, 0.0f);
        for (std::size_t c = 0; c < channels.size(); ++c)
            for (std::size_t i = 0; i < std::min(now, channels[c].size() - std::min(at, channels[c].size())); ++i)
                interleaved[i * count + std::min(c, count - 1)] +=
                    static_cast<float>(count) * channels[c][at + i]; // the encoder takes their mean
        encoder.push(interleaved);
    }
    Clip clip = encoder.finish();
    undoGain(clip);
    clip.source = {};
    return clip;
}

} // namespace pacini
