#pragma once

// Scale of a whole sound, which the encoder needs before it encodes parts of it.

#include <pacini/analysis/BandAnalysis.h>

#include <cstddef>

namespace pacini
{

/// Scale of a whole sound.
struct SoundScale
{
    double peak = 0.0;      ///< largest magnitude that is felt, BandAnalysisResult::peak or more
    double loudest = 0.0;   ///< largest HeardFrame::loudness
    double strongest = 0.0; ///< largest HeardFrame::power
    bool operator==(const SoundScale&) const = default;
};

/// Parts in which long sounds are encoded, so that memory does not grow with them.
struct SoundSection
{
    static constexpr double seconds = 600.0; ///< a multiple of three frames of the bands
    /// Length of the next section that a section waits for. Masking by a loud event falls 20 dB a second towards
    /// earlier events: beyond this time, no event between silence and the largest sample is masked. In HeardShares,
    /// power counts 87 dB less by then.
    static constexpr double secondsAhead = 20.0;

    // The same in values of BandAnalysisResult::envelope.
    static constexpr auto frames = static_cast<std::size_t>(seconds / BandAnalysisResult::envelopeStep + 0.5);
    static constexpr auto framesAhead = static_cast<std::size_t>(secondsAhead / BandAnalysisResult::envelopeStep + 0.5);
    static constexpr std::size_t framesSeen = frames + 1 + framesAhead; ///< the frame at the cut is in both sections
};

} // namespace pacini
