#include "cli/bench/Bench.h"
#include "cli/bench/Timed.h"

#include <pacini/analysis/AnalysisInput.h>
#include <pacini/analysis/EncodeSound.h>
#include <pacini/analysis/HeardLevel.h>
#include <pacini/analysis/OnsetFeatures.h>
#include <pacini/evaluate/match/MatchParts.h>
#include <pacini/synthesis/Decoder.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pacini::cli
{

namespace
{
constexpr double secondsHeard = 10.0; // of each sound

/// What is heard by the encoder's estimate from seven bands, 5 ms each, brought to the rate of the measure.
HeardTrack estimatedTrack(std::span<const float> mono, int sampleRate)
{
    AnalysisInput input;
    input.start(sampleRate, 1);
    OnsetFeatures features(sampleRate, 1);
    HeardLevel level;
    const auto take = [&]
    {
        level.push(features.frames());
        features.drop(features.frames().size());
    };
    features.push(input.push(mono));
    take();
    input.finish();
    features.finish();
    take();
    const double duration = static_cast<double>(mono.size()) / sampleRate;
    level.finish(static_cast<std::int64_t>(duration / BandAnalysisResult::envelopeStep) + 2);
    const auto frames = level.found();
    // matchParts() takes 3 values of delay out, which the estimate has not.
    constexpr double delay = 3.0 / HeardTrack::rate;
    HeardTrack track;
    for (std::size_t i = 0; static_cast<double>(i) < duration * HeardTrack::rate; ++i)
    {
        const double at =
            std::max(0.0, static_cast<double>(i) / HeardTrack::rate - delay) / BandAnalysisResult::envelopeStep;
        const std::size_t first = std::min(static_cast<std::size_t>(at), frames.size() - 2);
        const double part = std::min(1.0, at - static_cast<double>(first));
        track.loudness.push_back(static_cast<float>((1.0 - part) * static_cast<double>(frames[first].loudness) +
                                                    part * static_cast<double>(frames[first + 1].loudness)));
        track.sharpness.push_back(1.0f);
    }
    return track;
}

/// Every second value twice.
HeardTrack halved(HeardTrack track)
{
    for (std::size_t i = 1; i < track.loudness.size(); i += 2)
    {
        track.loudness[i] = track.loudness[i - 1];
        track.sharpness[i] = track.sharpness[i - 1];
    }
    return track;
}

std::vector<TouchTrack> vibrationsOf(std::span<const float> mono, int sampleRate)
{
    constexpr int rate = 8000; // Hz
    TouchAnalyzer touch;
    std::vector<TouchTrack> tracks;
    for (const double audible : {0.0, 0.5, 1.0})
    {
        EncoderParams params;
        params.audible = audible;
        Encoder encoder(params);
        encoder.start(sampleRate, 1);
        encoder.push(mono);
        DecoderParams decoding;
        decoding.sampleRate = rate;
        Decoder decoder(encoder.finish(), decoding);
        std::vector<float> drive(static_cast<std::size_t>(decoder.totalFrames()));
        decoder.process(drive);
        tracks.push_back(touchTrack(touch, drive, rate).value());
    }
    return tracks;
}

void measureMatch(const BenchSound& sound, const BenchSettings& settings, BenchTable& rows)
{
    const auto mono = sound.beginning(secondsHeard);
    const auto vibrations = vibrationsOf(mono, sound.sampleRate);
    const double duration = static_cast<double>(mono.size()) / sound.sampleRate;
    const auto predictions = [&](const HeardTrack& heard)
    {
        std::vector<double> all;
        for (const TouchTrack& felt : vibrations)
            all.push_back(predictedMatch(matchParts(heard, felt)));
        return all;
    };
    std::vector<double> exact;
    const auto add = [&](const char* loudness, double step, double value, auto&& hear)
    {
        const auto heard = timed(settings.repeats, hear);
        const auto predicted = predictions(heard.result);
        if (exact.empty())
            exact = predicted;
        double sum = 0.0;
        double largest = 0.0;
        for (std::size_t i = 0; i < predicted.size(); ++i)
        {
            const double error = std::abs(predicted[i] - exact[i]);
            sum += error;
            largest = std::max(largest, error);
        }
        rows.add({sound.name, loudness, fmt::format("{}", step), fmt::format("{}", value), duration, heard.seconds,
                  sum / static_cast<double>(predicted.size()), largest});
    };
    constexpr double samplesPerMillisecond = 48.0;
    for (const std::size_t hop : {24u, 12u, 48u, 96u, 192u})
        add("ISO 532-1", static_cast<double>(hop) / samplesPerMillisecond, hop > 96 ? 4.0 : 2.0,
            [&] { return heardTrack(mono, sound.sampleRate, Decibels(75.0), hop).value(); });
    add("ISO 532-1", 0.5, 4.0, [&] { return halved(heardTrack(mono, sound.sampleRate, Decibels(75.0), 24).value()); });
    add("seven bands", 5.0, 5.0, [&] { return estimatedTrack(mono, sound.sampleRate); });
}
} // namespace

Bench matchBench()
{
    return {
        "match",
        "Shortcuts of predicted match",
        "What is heard of the first 10 s of each sound, by ISO 532-1 with levels of 28 bands each .5 ms and a value "
        "of loudness each 2 ms (first row), with other steps and values (`pacini compare` takes 1 ms), and by the "
        "estimate from seven bands that the encoder makes beside its events. Error is how far the match that is "
        "predicted with it lies from that of the first row, the mean over three clips of the sound (--audible 0, "
        ".5 and 1), largest that of the worst; means over the sounds.",
        columnsOf({"loudness"}, {{"step", "ms", Reduction::key},
                                 {"value", "ms", Reduction::key},
                                 summed("duration", "s"),
                                 summed("seconds", "s"),
                                 {"error", ""},
                                 {"largest", ""},
                                 {"timesRealTime", "", Reduction::ratio, "duration", "seconds"},
                                 {"time", "ms/s", Reduction::ratio, "seconds", "duration", 1000.0},
                                 {"relativeTime", "", Reduction::relative, "time"}}),
        {{"", "Error of predicted match against time", "loudness", "time", "error", "step", {}, {}, false}},
        {},
        measureMatch};
}

} // namespace pacini::cli
