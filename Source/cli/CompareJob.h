#pragma once

// Comparison job: the quality measures of one candidate against its reference.

#include "cli/ComparePairs.h"
#include "io/AudioReader.h"
#include "io/OnsetFile.h"

#include <pacini/evaluate/Comparison.h>

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
struct CompareResult : Comparison
{
    double seconds = 0.0;                       ///< s of work, without access to files
    std::vector<std::string> warnings;          ///< of the clip whose events were compared
    std::vector<std::string> referenceWarnings; ///< of the sounds
    std::vector<std::string> candidateWarnings;
};

/// Compares pairs one after another; keeps transforms between them. One thread at a time.
class CompareJob
{
public:
    /// `threads`: 2 or more for two of them within a pair, where there is no other pair for the second.
    CompareJob(const CompareSettings& settings, unsigned threads);

    /// Compares over the reference's length; a clip as candidate is rendered first. Channels are mixed down to their
    /// mean; rates from 2 to 768 kHz. `progress(share)` is called now and then. A failure names the file: those of
    /// AudioReader, tooLarge beyond 24 hours, those of readClip and renderScene.
    [[nodiscard]] std::variant<CompareResult, InputFailure> run(const ComparePair& pair,
                                                                const std::function<void(double)>& progress);

private:
    CompareSettings settings;
    bool two; // threads
    Comparer comparer;
};

} // namespace pacini::cli
