#pragma once

// Comparison job: the quality measures of one candidate against its reference.

#include "cli/ComparePairs.h"
#include "io/AudioReader.h"
#include "io/OnsetFile.h"

#include <pacini/evaluate/EventMatching.h>
#include <pacini/evaluate/Hts.h>
#include <pacini/evaluate/SignalMetrics.h>
#include <pacini/evaluate/match/FeltImpression.h>
#include <pacini/evaluate/match/MatchLag.h>
#include <pacini/evaluate/match/MatchParts.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace pacini::cli
{

struct CompareSettings
{
    bool allowTruncated = false;
    bool strict = false; ///< see readClip()
    std::optional<Onsets> onsets;
    Onsets ambiguous; ///< events that count neither for nor against
};

/// Result of the comparison of one pair.
struct CompareResult
{
    double duration = 0.0;             ///< s of the reference
    double candidateDuration = 0.0;    ///< s
    double seconds = 0.0;              ///< s of work, without access to files
    std::uint64_t notFinite = 0;       ///< frames of both files that were NaN or infinite
    std::vector<std::string> warnings; ///< of the clip whose events were compared
    HtsScore hts;
    double ceiling = 0.0; ///< HTS of the reference itself, played as it is
    HtsScore htsFidelity;
    SignalMetrics measures;
    FeltFigures impression;                 ///< of the candidate
    std::optional<MatchParts> match;        ///< empty for a silent reference
    double matchLag = 0.0;                  ///< ms by which the candidate is late, as far as that can be told
    bool aligned = false;                   ///< `match` is that without it: both are of different length
    double matchCeiling = 0.0;              ///< predicted match of the reference itself, played as it is
    std::optional<EventScore> events;       ///< within 25 ms; with onsets of this reference only
    std::optional<EventScore> eventsNarrow; ///< within 10 ms
};

/// Compares pairs one after another; keeps transforms between them. One thread at a time.
class CompareJob
{
public:
    explicit CompareJob(const CompareSettings& settings);

    /// Compares over the reference's length. Channels are mixed down to their mean; rates from 2 to 768 kHz.
    /// `progress(share)` is called now and then. A failure names the file: those of AudioReader, tooLarge beyond 24
    /// hours, and of readClip.
    [[nodiscard]] std::variant<CompareResult, InputFailure> run(const ComparePair& pair,
                                                                const std::function<void(double)>& progress);

private:
    CompareSettings settings;
    HtsAnalyzer hts;
    TouchAnalyzer touch;
};

} // namespace pacini::cli
