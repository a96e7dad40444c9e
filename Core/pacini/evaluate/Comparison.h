#pragma once

// Comparison of a candidate with its reference by all measures of quality.

#include <pacini/evaluate/EventMatching.h>
#include <pacini/evaluate/Hts.h>
#include <pacini/evaluate/LowPart.h>
#include <pacini/evaluate/SignalMetrics.h>
#include <pacini/evaluate/match/FeltImpression.h>
#include <pacini/evaluate/match/MatchLag.h>
#include <pacini/evaluate/match/MatchParts.h>
#include <pacini/filters/Resampler.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Result.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini
{

/// Results of all measures for a candidate.
struct Comparison
{
    double duration = 0.0;          ///< s of the reference
    double candidateDuration = 0.0; ///< s
    std::uint64_t notFinite = 0;    ///< frames of both sounds that were NaN, infinite or beyond limits::sample
    HtsScore hts;
    double ceiling = 0.0; ///< HTS of the reference itself, played as it is
    HtsScore htsFidelity;
    LowPart low;
    SignalMetrics measures;
    FeltFigures impression;                 ///< of the candidate
    std::optional<MatchParts> match;        ///< empty for a silent reference
    double matchLag = 0.0;                  ///< delay of the candidate, ms, if it can be determined
    bool aligned = false;                   ///< `match` is that without it: both are of different length
    double matchOfSound = 0.0;              ///< predicted match of the reference itself, played as it is
    std::optional<EventScore> events;       ///< within 25 ms; with known onsets only
    std::optional<EventScore> eventsNarrow; ///< within 10 ms
};

/// One number of a comparison, by its key in reports.
struct ComparisonFigure
{
    std::string_view key;
    std::optional<double> (*value)(const Comparison&); ///< nothing where the measure says nothing
};

namespace detail
{
/// A measure of the judge, which a silent reference has not.
template <double SignalMetrics::*member>
[[nodiscard]] std::optional<double> judged(const Comparison& comparison)
{
    return comparison.measures.silentReference ? std::nullopt : std::optional(comparison.measures.*member);
}

template <std::optional<EventScore> Comparison::*member>
[[nodiscard]] std::optional<double> scored(const Comparison& comparison)
{
    return (comparison.*member) ? std::optional((comparison.*member)->f) : std::nullopt;
}
} // namespace detail

/// The figures of a comparison, the most telling first.
inline constexpr std::array<ComparisonFigure, 15> comparisonFigures{{
    {"match",
     [](const Comparison& c)
     {
         return c.match ? std::optional(predictedMatch(*c.match)) : std::nullopt;
     }},
    {"matchOfSound",
     [](const Comparison& c)
     {
         return c.match ? std::optional(c.matchOfSound) : std::nullopt;
     }},
    {"hts",
     [](const Comparison& c)
     {
         return std::optional(c.hts.score);
     }},
    {"ceiling",
     [](const Comparison& c)
     {
         return std::optional(c.ceiling);
     }},
    {"htsF",
     [](const Comparison& c)
     {
         return std::optional(c.htsFidelity.score);
     }},
    {"lowKept",
     [](const Comparison& c)
     {
         return c.low.kept;
     }},
    {"beatKept",
     [](const Comparison& c)
     {
         return c.low.beat;
     }},
    {"lsd", detail::judged<&SignalMetrics::logSpectralDistance>},
    {"wideSnr", detail::judged<&SignalMetrics::wideSnr>},
    {"bandSnr", detail::judged<&SignalMetrics::envelopeSnr>},
    {"bandSnrPerBand", detail::judged<&SignalMetrics::envelopeSnrPerBand>},
    {"centroidError", detail::judged<&SignalMetrics::centroidError>},
    {"centroidBias", detail::judged<&SignalMetrics::centroidBias>},
    {"f1", detail::scored<&Comparison::events>},
    {"f1Within10ms", detail::scored<&Comparison::eventsNarrow>},
}};

/// Treatment of frames that no sound has: NaN, infinite, or beyond limits::sample.
enum class UnsoundFrames
{
    refuse,
    silence, ///< they count as silence, with all that a filter makes of them; Comparison::notFinite tells how many
};

/// Runs two jobs that do not need each other, one after the other. Comparer takes another such function where there are
/// threads; what a job throws must come out of it.
struct OneAfterOther
{
    template <typename First, typename Second>
    void operator()(const First& first, const Second& second) const
    {
        first();
        second();
    }
};

/// Compares one pair after another; keeps transforms between them: setReference(), setCandidate(), compare(). Samples
/// are mono, at 2 to 768 kHz. One thread at a time; allocates.
class Comparer
{
public:
    explicit Comparer(UnsoundFrames treatment = UnsoundFrames::refuse) : unsound(treatment) {}

    /// Begins a pair. Errors: a rate that is not 2 to 768 kHz (invalidArgument), a frame that no sound has (notFinite,
    /// with its place).
    template <typename Both = OneAfterOther>
    [[nodiscard]] Result<void> setReference(std::span<const float> sound, int sampleRate, const Both& both = {})
    {
        if (auto valid = checkResamplerRate(sampleRate); !valid)
            return valid;
        found = {};
        const auto checked = soundFrames(sound, "reference");
        if (!checked)
            return checked.error();
        const std::span<const float> mono = *checked;
        found.duration = durationOf(mono, sampleRate);
        judge.emplace(signalAnalysisLength(mono.size(), sampleRate));
        Result<void> analyzed;
        Result<HeardTrack> heard = HeardTrack{};
        both([&] { analyzed = analyzeReference(mono, sampleRate); }, [&] { heard = heardTrack(mono, sampleRate); });
        if (!analyzed)
            return analyzed;
        if (!heard)
            return heard.error();
        source.heard = std::move(*heard);
        return {};
    }

    /// After setReference(). Errors: as there.
    template <typename Both = OneAfterOther>
    [[nodiscard]] Result<void> setCandidate(std::span<const float> sound, int sampleRate, const Both& both = {})
    {
        if (auto valid = checkResamplerRate(sampleRate); !valid)
            return valid;
        const auto checked = soundFrames(sound, "candidate");
        if (!checked)
            return checked.error();
        const std::span<const float> mono = *checked;
        found.candidateDuration = durationOf(mono, sampleRate);
        return analyze(mono, sampleRate, target, target.hts, HtsRole::candidate, both);
    }

    /// Times of the events in the candidate, s.
    [[nodiscard]] const std::vector<double>& onsets() const noexcept { return target.judge.onsets; }

    /// The comparison over the reference's length. After setCandidate().
    [[nodiscard]] Comparison compare()
    {
        using pacini::compare;
        found.hts = compare(source.hts, target.hts, HtsMode::translation);
        found.ceiling = compare(source.hts, source.itself, HtsMode::translation).score;
        found.htsFidelity = compare(source.hts, target.hts, HtsMode::fidelity);
        found.low = compareLowPart(source.hts, target.hts);
        found.measures = compare(source.judge, target.judge);
        found.impression = feltFigures(target.felt);
        if (!source.heard.loudness.empty())
        {
            // One that was made for the sound is as late as it will be felt; a recording begins when it was begun.
            const int late = matchLag(source.heard, target.felt);
            found.aligned = late != 0 && std::abs(found.duration - found.candidateDuration) > 0.005;
            found.matchLag = 1000.0 * late / TouchTrack::rate;
            const HeardCourse heard(source.heard);
            found.match = heard.with(found.aligned ? earlier(target.felt, late) : target.felt);
            found.matchOfSound = predictedMatch(heard.with(source.felt));
        }
        return found;
    }

private:
    /// Precomputed features of one sound.
    struct Features
    {
        HtsFeatures hts;
        HtsFeatures itself; ///< of a source: as its own candidate
        SignalFeatures judge;
        HeardTrack heard; ///< of a source
        TouchTrack felt;
    };

    [[nodiscard]] static double durationOf(std::span<const float> mono, int sampleRate)
    {
        return static_cast<double>(mono.size()) / sampleRate;
    }

    /// The frames as they are measured. Valid until the next call.
    [[nodiscard]] Result<std::span<const float>> soundFrames(std::span<const float> sound, const char* name)
    {
        if (areWithinLimit(sound))
            return sound;
        marked.assign(sound.begin(), sound.end());
        for (std::size_t i = 0; i < marked.size(); ++i)
        {
            const float frame = marked[i];
            if (std::abs(frame) <= limits::sample)
                continue;
            if (unsound == UnsoundFrames::refuse)
                return Error{ErrorCode::notFinite, std::string(name) + "[" + std::to_string(i) + "]",
                             std::isnan(frame)   ? "is NaN"
                             : std::isinf(frame) ? "is infinite"
                                                 : "is far beyond full scale"};
            marked[i] = std::numeric_limits<float>::quiet_NaN();
            ++found.notFinite;
        }
        return std::span<const float>(marked);
    }

    /// All of a reference but what is heard of it.
    [[nodiscard]] Result<void> analyzeReference(std::span<const float> mono, int sampleRate)
    {
        if (auto done = analyze(mono, sampleRate, source, source.itself, HtsRole::sourceItself, OneAfterOther{}); !done)
            return done;
        auto wanted = htsSourceFeatures(hts, mono, sampleRate);
        if (!wanted)
            return wanted.error();
        source.hts = std::move(*wanted);
        return {};
    }

    template <typename Both>
    [[nodiscard]] Result<void> analyze(std::span<const float> mono, int sampleRate, Features& features,
                                       HtsFeatures& asCandidate, HtsRole role, const Both& both)
    {
        features = {};
        Result<SignalFeatures> judged = SignalFeatures{};
        Result<std::vector<float>> low = std::vector<float>{};
        both([&] { judged = signalFeatures(*judge, mono, sampleRate); },
             [&]
             {
                 low = resampleFinite(mono, sampleRate, HtsFeatures::sampleRate);
                 if (!low)
                     return;
                 asCandidate = hts.analyze(std::span<const float>(*low), role);
                 features.felt = touch.analyze(*low);
             });
        if (!judged)
            return judged.error();
        if (!low)
            return low.error();
        features.judge = std::move(*judged);
        return {};
    }

    HtsAnalyzer hts;
    TouchAnalyzer touch;
    std::optional<SignalAnalyzer> judge;
    UnsoundFrames unsound;
    std::vector<float> marked;
    Features source, target;
    Comparison found;
};

/// Scores `events` of a candidate against known `onsets`, both in s; `ambiguous` ones count neither way.
inline void scoreEvents(Comparison& comparison, const std::vector<double>& onsets, const std::vector<double>& events,
                        std::span<const double> ambiguous = {})
{
    comparison.events = scoreEvents(onsets, events, 0.025, ambiguous);
    comparison.eventsNarrow = scoreEvents(onsets, events, 0.010, ambiguous);
}

} // namespace pacini
