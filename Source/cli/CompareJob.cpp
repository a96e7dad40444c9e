#include "cli/CompareJob.h"

#include "cli/ReadingAdvice.h"
#include "cli/Stopwatch.h"
#include "io/ClipFile.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace fs = std::filesystem;

namespace
{
/// A sound mixed down to one channel.
struct MonoSound
{
    int sampleRate = 0;
    std::vector<float> samples;
    std::uint64_t notFinite = 0;

    [[nodiscard]] double duration() const { return static_cast<double>(samples.size()) / sampleRate; }
};

void appendMean(std::span<const float> interleaved, std::size_t channels, std::vector<float>& mono)
{
    if (channels == 1)
    {
        mono.insert(mono.end(), interleaved.begin(), interleaved.end());
        return;
    }
    for (std::size_t i = 0; i < interleaved.size(); i += channels)
    {
        double sum = 0.0;
        for (std::size_t c = 0; c < channels; ++c)
            sum += static_cast<double>(interleaved[i + c]);
        mono.push_back(static_cast<float>(sum / static_cast<double>(channels)));
    }
}

/// Mixes while reading, so that the channels are never in memory all at once.
Result<MonoSound> readMono(const fs::path& path, const AudioReadOptions& options, Stopwatch& work)
{
    auto reader = AudioReader::open(path, options);
    if (!reader)
        return reader.error();
    MonoSound sound;
    sound.sampleRate = reader->sampleRate();
    const auto channels = static_cast<std::size_t>(reader->channels());
    const auto read = reader->forEachBlock(65536 / channels,
                                           [&](std::span<const float> block)
                                           {
                                               work.run([&] { appendMean(block, channels, sound.samples); });
                                               return sound.duration() <= limits::duration;
                                           });
    if (!read)
        return read.error();
    if (sound.duration() > limits::duration)
        return Error{ErrorCode::tooLarge, "", "is longer than 24 hours; cut it into parts"};
    work.run(
        [&]
        {
            sound.notFinite = static_cast<std::uint64_t>(
                std::count_if(sound.samples.begin(), sound.samples.end(), [](float v) { return !std::isfinite(v); }));
        });
    return sound;
}

/// What both measures need of one sound.
struct Features
{
    HtsFeatures hts;
    HtsFeatures itself; ///< of a source: as its own candidate
    SignalFeatures judge;
    HeardTrack heard; ///< of a source
    TouchTrack felt;
};
} // namespace

CompareJob::CompareJob(const CompareSettings& wanted) : settings(wanted) {}

std::variant<CompareResult, InputFailure> CompareJob::run(const ComparePair& pair,
                                                          const std::function<void(double)>& progress)
{
    // The judge counts what is not finite as silence after resampling, so it must come through.
    const AudioReadOptions reading{
        .allowTruncated = settings.allowTruncated, .keepNan = true, .lowestSampleRate = lowestResamplerRate};
    CompareResult result;
    Stopwatch work;
    std::optional<SignalAnalyzer> judge;
    const auto analyze = [&](const fs::path& path, HtsRole role) -> std::variant<Features, InputFailure>
    {
        const auto sound = readMono(path, reading, work);
        if (!sound)
            return InputFailure{path, withAdvice(sound.error(), false)};
        (role == HtsRole::source ? result.duration : result.candidateDuration) = sound->duration();
        result.notFinite += sound->notFinite;
        const std::span<const float> samples(sound->samples);
        Features features;
        work.run(
            [&]
            {
                // The reader has checked the rate, the only thing that can be wrong here.
                if (role == HtsRole::source)
                    judge.emplace(signalAnalysisLength(samples.size(), sound->sampleRate));
                features.judge = signalFeatures(*judge, samples, sound->sampleRate).value();
                HtsFeatures& asCandidate = role == HtsRole::source ? features.itself : features.hts;
                asCandidate = htsCandidateFeatures(hts, samples, sound->sampleRate).value();
                features.felt = touchTrack(touch, samples, sound->sampleRate).value();
                if (role == HtsRole::source)
                {
                    features.hts = htsSourceFeatures(hts, samples, sound->sampleRate).value();
                    features.heard = heardTrack(samples, sound->sampleRate).value();
                }
            });
        return features;
    };
    const auto reference = analyze(pair.reference, HtsRole::source);
    if (const auto* failure = std::get_if<InputFailure>(&reference))
        return *failure;
    progress(0.5);
    const auto candidate = analyze(pair.candidate, HtsRole::candidate);
    if (const auto* failure = std::get_if<InputFailure>(&candidate))
        return *failure;
    const Features& source = std::get<Features>(reference);
    const Features& target = std::get<Features>(candidate);

    std::vector<double> events = target.judge.onsets;
    if (!pair.events.empty())
    {
        const auto read = readClip(pair.events, settings.strict);
        if (!read)
            return InputFailure{pair.events, read.error()};
        result.warnings = read->warnings;
        events.clear();
        for (const Transient& transient : read->clip.transients)
            events.push_back(transient.time);
    }
    work.run(
        [&]
        {
            result.hts = compare(source.hts, target.hts, HtsMode::translation);
            result.ceiling = compare(source.hts, source.itself, HtsMode::translation).score;
            result.htsFidelity = compare(source.hts, target.hts, HtsMode::fidelity);
            result.measures = compare(source.judge, target.judge);
            result.impression = feltFigures(target.felt);
            if (!source.heard.loudness.empty())
            {
                // One that was made for the sound is as late as it will be felt; a recording begins when it was begun.
                const int late = matchLag(source.heard, target.felt);
                result.aligned = late != 0 && std::abs(result.duration - result.candidateDuration) > 0.005;
                result.matchLag = 1000.0 * late / TouchTrack::rate;
                result.match = matchParts(source.heard, earlier(target.felt, result.aligned ? late : 0));
                result.matchCeiling = predictedMatch(matchParts(source.heard, source.felt));
            }
            const auto* onsets = settings.onsets ? settings.onsets->find(pair.reference) : nullptr;
            if (onsets == nullptr)
                return;
            const auto* ambiguous = settings.ambiguous.find(pair.reference);
            const auto others = ambiguous != nullptr ? std::span(*ambiguous) : std::span<const double>();
            result.events = scoreEvents(*onsets, events, 0.025, others);
            result.eventsNarrow = scoreEvents(*onsets, events, 0.010, others);
        });
    result.seconds = work.seconds();
    return result;
}

} // namespace pacini::cli
