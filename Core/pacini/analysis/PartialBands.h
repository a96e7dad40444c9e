#pragma once

// Assignment of partials to bands: many sinusoids that come and go, on the few carriers of a clip.

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/PartialTracking.h>
#include <pacini/clip/BandTiling.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Tracks of `frames` frames, one for each of the bands, which adjoin each other, from partials on the same frames. A
/// partial stays for its life in the band that holds its power-weighted mean frequency, so that one which glides is not
/// cut at the edges; those below the first band count to the first, those above the last to the last. Where a band has
/// several, its amplitude is that of their power together, its frequency that of the strongest. [any]
[[nodiscard]] inline std::vector<BandAnalysisResult::Track>
partialTracks(std::span<const Partial> partials, std::span<const BandEdges> bands, std::size_t frames)
{
    std::vector<BandAnalysisResult::Track> tracks(bands.size(),
                                                  {std::vector<float>(frames), std::vector<float>(frames)});
    std::vector<std::vector<float>> strongest(bands.size(), std::vector<float>(frames));
    for (const Partial& partial : partials)
    {
        double power = 0.0;
        double moment = 0.0;
        for (const PartialPoint& point : partial.points)
        {
            power += point.amplitude * point.amplitude;
            moment += point.amplitude * point.amplitude * point.frequency;
        }
        std::size_t k = 0;
        while (k + 1 < bands.size() && moment > power * bands[k].high)
            ++k;
        const std::size_t end = std::min(partial.death(), frames);
        for (std::size_t m = partial.birth; m < end; ++m)
        {
            const PartialPoint& point = partial.points[m - partial.birth];
            const auto amplitude = static_cast<float>(point.amplitude);
            const float before = tracks[k].amplitude[m];
            tracks[k].amplitude[m] = std::sqrt(before * before + amplitude * amplitude);
            if (amplitude > strongest[k][m])
            {
                strongest[k][m] = amplitude;
                tracks[k].frequency[m] = static_cast<float>(point.frequency);
            }
        }
    }
    return tracks;
}

} // namespace pacini
