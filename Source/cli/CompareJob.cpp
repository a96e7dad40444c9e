#include "cli/CompareJob.h"

#include "cli/ReadingAdvice.h"
#include "io/ClipFile.h"
#include "io/FileExtension.h"
#include "io/Stopwatch.h"

#include <pacini/synthesis/RenderScene.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <span>
#include <system_error>
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
    std::vector<std::string> warnings;

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
    sound.warnings = reader->warnings();
    return sound;
}

/// By extension: what exports of clips to WAV are, too.
bool isSound(const fs::path& path)
{
    const auto& extensions = audioExtensions();
    return std::find(extensions.begin(), extensions.end(), lowerExtension(path)) != extensions.end();
}

/// The drive of a clip as `pacini render` writes it when no option is given.
Result<MonoSound> readDrive(const fs::path& path, bool strict, Stopwatch& work)
{
    auto read = readClip(path, strict);
    if (!read)
        return read.error();
    Result<RenderedScene> rendered = RenderedScene{};
    const RenderParams params;
    work.run([&] { rendered = renderScene(sceneOf(std::move(read->clip)), nullptr, params); });
    if (!rendered)
        return rendered.error();
    return MonoSound{static_cast<int>(params.compile.sampleRate), std::move(rendered->samples),
                     std::move(read->warnings)};
}

/// Runs two jobs at the same time, or one after the other where no second thread is wanted or to be had.
struct SideBySide
{
    bool two;

    template <typename First, typename Second>
    void operator()(const First& first, const Second& second) const
    {
        std::future<void> other;
        try
        {
            other = std::async(two ? std::launch::async : std::launch::deferred, second);
        }
        catch (const std::system_error&)
        {
            other = std::async(std::launch::deferred, second);
        }
        first();
        other.get();
    }
};

/// Onsets behind the sound are times of another sound, or in another unit.
void warnOfLateOnsets(const std::vector<double>& onsets, CompareResult& result)
{
    constexpr double tolerance = 0.1; // s
    const auto late =
        std::count_if(onsets.begin(), onsets.end(), [&](double time) { return time > result.duration + tolerance; });
    if (late > 0)
        result.referenceWarnings.push_back(
            fmt::format("{} of its {} onsets are after its end at {:.2f} s; onsets are in "
                        "seconds",
                        late, onsets.size(), result.duration));
}
} // namespace

CompareJob::CompareJob(const CompareSettings& wanted, unsigned threads)
    : settings(wanted), two(threads > 1), comparer(UnsoundFrames::silence)
{
}

std::variant<CompareResult, InputFailure> CompareJob::run(const ComparePair& pair,
                                                          const std::function<void(double)>& progress)
{
    // What no sound has counts as silence after resampling, so it must come through; the command warns of it.
    const AudioReadOptions reading{.allowTruncated = settings.allowTruncated,
                                   .keepNan = true,
                                   .lowestSampleRate = lowestResamplerRate,
                                   .lowFrequencyGain = lowFrequencyEffectsGain};
    Stopwatch work;
    const auto analyze = [&](const fs::path& path, const Result<MonoSound>& sound,
                             Result<void> (Comparer::*set)(std::span<const float>, int, const SideBySide&),
                             std::vector<std::string>& warnings) -> std::optional<InputFailure>
    {
        if (!sound)
            return InputFailure{path, withAdvice(sound.error(), false)};
        warnings = sound->warnings;
        Result<void> done;
        work.run([&] { done = (comparer.*set)(sound->samples, sound->sampleRate, SideBySide{two}); });
        return done ? std::nullopt : std::optional(InputFailure{path, done.error()});
    };
    CompareResult result;
    if (!isSound(pair.reference) && looksLikeClip(pair.reference))
        return InputFailure{pair.reference,
                            {ErrorCode::invalidArgument, "", "is a clip; name its sound first, then the clip"}};
    if (auto failure = analyze(pair.reference, readMono(pair.reference, reading, work),
                               &Comparer::setReference<SideBySide>, result.referenceWarnings))
        return *failure;
    progress(0.5);
    const auto candidate = !isSound(pair.candidate) && looksLikeClip(pair.candidate)
                               ? readDrive(pair.candidate, settings.strict, work)
                               : readMono(pair.candidate, reading, work);
    if (auto failure =
            analyze(pair.candidate, candidate, &Comparer::setCandidate<SideBySide>, result.candidateWarnings))
        return *failure;

    std::vector<double> events = comparer.onsets();
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
            static_cast<Comparison&>(result) = comparer.compare();
            const auto* onsets = settings.onsets ? settings.onsets->find(pair.reference) : nullptr;
            if (onsets == nullptr)
                return;
            const auto* ambiguous = settings.ambiguous.find(pair.reference);
            scoreEvents(result, *onsets, events,
                        ambiguous != nullptr ? std::span(*ambiguous) : std::span<const double>());
            warnOfLateOnsets(*onsets, result);
        });
    result.seconds = work.seconds();
    return result;
}

} // namespace pacini::cli
