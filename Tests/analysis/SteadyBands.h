#pragma once

// Ten seconds of steady bands, for what changes them by what is heard.

#include <pacini/analysis/BandAnalysis.h>

#include <cstddef>
#include <vector>

namespace pacini::test
{

constexpr std::size_t steadyFrames = 2000; // of the envelope

inline const std::vector<BandEdges> steadyEdges = {{50.0, 70.0, 100.0}, {100.0, 170.0, 300.0}, {300.0, 500.0, 900.0}};

inline BandAnalysisResult steadyBands(float amplitude)
{
    BandAnalysisResult found;
    found.peak = 1.0;
    found.envelope.assign(steadyFrames, amplitude);
    for (const BandEdges& edge : steadyEdges)
        found.tracks.push_back({std::vector<float>(steadyFrames / 4, amplitude),
                                std::vector<float>(steadyFrames / 4, static_cast<float>(edge.centre))});
    return found;
}

} // namespace pacini::test
