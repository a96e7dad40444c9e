#include "cli/bench/Bench.h"
#include "cli/bench/Timed.h"
#include "io/AudioReader.h"

#include <pacini/analysis/EncodeSound.h>
#include <pacini/analysis/OnsetDetector.h>
#include <pacini/analysis/OnsetFeatures.h>
#include <pacini/clip/PackedClip.h>

#include <algorithm>

namespace pacini::cli
{

namespace
{
std::vector<std::vector<float>> decimatedChannels(const BenchSound& sound, std::vector<RationalDecimator>& decimators)
{
    const std::size_t channels = decimators.size();
    std::vector<std::vector<float>> low(channels);
    for (RationalDecimator& decimator : decimators)
        decimator.reset();
    std::vector<float> channel;
    SoundParts parts(sound.interleaved, sound.channels);
    for (SoundPart part = parts(); !part->empty(); part = parts())
        for (std::size_t c = 0; c < channels; ++c)
        {
            channel.clear();
            for (std::size_t i = c; i < part->size(); i += channels)
                channel.push_back((*part)[i]);
            decimators[c].push(channel, low[c]);
        }
    for (std::size_t c = 0; c < channels; ++c)
        decimators[c].finish(low[c]);
    return low;
}

std::vector<Onset> onsetsOf(const BenchSound& sound, const OnsetParams& params)
{
    const auto channels = static_cast<std::size_t>(sound.channels);
    OnsetFeatures features(sound.sampleRate, channels);
    OnsetDetector detector(params);
    const auto hand = [&]
    {
        detector.push(features.frames());
        features.drop(features.frames().size());
    };
    SoundParts parts(sound.interleaved, sound.channels);
    for (SoundPart part = parts(); !part->empty(); part = parts())
    {
        features.push(*part);
        hand();
    }
    features.finish();
    hand();
    return detector.finish();
}

void measureStages(const BenchSound& sound, const BenchSettings& settings, BenchTable& rows)
{
    const EncoderParams params;
    const auto encodeWith = [&sound](Encoder& encoder)
    {
        return encodePrecisely(encoder, {sound.sampleRate, sound.channels},
                               SoundParts(sound.interleaved, sound.channels))
            .value();
    };
    Encoder encoder(params);
    const auto encode = timed(settings.repeats, [&] { return encodeWith(encoder); });
    const auto encodeFirst = timed(settings.repeats,
                                   [&]
                                   {
                                       Encoder fresh(params);
                                       return encodeWith(fresh);
                                   });
    const auto pack = timed(settings.repeats, [&] { return packClip(encode.result, packParamsFor(encode.result)); });

    std::vector<RationalDecimator> decimators(static_cast<std::size_t>(sound.channels),
                                              RationalDecimator(sound.sampleRate, analysisRate));
    const auto decimate = timed(settings.repeats, [&] { return decimatedChannels(sound, decimators); });
    BandAnalysis analysis({tiledBands(static_cast<std::size_t>(params.bands), params.lowFrequency, params.highFrequency,
                                      params.spacing)});
    const std::vector<std::span<const float>> channels(decimate.result.begin(), decimate.result.end());
    const auto analyse = timed(settings.repeats,
                               [&]
                               {
                                   analysis.reset(channels.size());
                                   analysis.push(channels);
                                   return analysis.finish();
                               });
    const auto onsets = timed(settings.repeats, [&] { return onsetsOf(sound, params.onsets); });
    const auto read = timed(settings.repeats, [&] { return readAudio(sound.path).ok(); });

    const double total = encode.seconds + pack.seconds;
    const auto add = [&](const std::string& stage, double seconds)
    {
        rows.add({sound.name, stage, sound.duration(), total, seconds});
    };
    add("find events", onsets.seconds);
    add("decimate to 4 kHz", decimate.seconds);
    add("band analysis", analyse.seconds);
    add("fit curves", encode.seconds - onsets.seconds - decimate.seconds - analyse.seconds);
    add("pack", pack.seconds);
    add("all of these", total);
    add("set up, once (not among these)", encodeFirst.seconds - encode.seconds);
    add("read the file (not among these)", read.seconds);
}
} // namespace

Bench stagesBench()
{
    return {
        "stages",
        "Stages of encoding",
        "What share of the time that `pacini encode` takes (default settings, without access to files) goes into "
        "each stage. Events, decimation, band analysis and packing are the encoder's own building blocks, run by "
        "themselves "
        "on the same data; the fit of all curves with their normalisation and pitches is what the whole encoder "
        "takes beyond them; setting up is what the first sound takes beyond a later one. Shares are of the total over "
        "all sounds.",
        columnsOf({"stage"}, {summed("duration", "s"),
                              summed("totalSeconds", "s"),
                              summed("seconds", "s"),
                              {"share", "%", Reduction::ratio, "seconds", "totalSeconds", 100.0},
                              {"time", "ms/s", Reduction::ratio, "seconds", "duration", 1000.0},
                              {"timesRealTime", "", Reduction::ratio, "duration", "seconds"}}),
        {},
        {},
        measureStages};
}

} // namespace pacini::cli
