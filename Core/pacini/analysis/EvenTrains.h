#pragma once

// Trains of similar events: felt as one rough vibration or as single hits, not as a level.

#include <pacini/analysis/OnsetMeasure.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Events closer than this may form a train, whose envelope is held down between them. Found by trial, without a
/// source.
inline constexpr double trainGapSeconds = 0.045;

/// Returns the onsets from 20 s before `start` on, with times relative to that: those that affect a part of a sound.
[[nodiscard]] inline std::vector<Onset> onsetsFrom(std::span<const Onset> onsets, double start)
{
    constexpr double before = 20.0;
    std::vector<Onset> rest;
    for (const Onset& onset : onsets)
        if (onset.time >= start - before)
        {
            rest.push_back(onset);
            rest.back().time -= start;
        }
    return rest;
}

/// Time range from the first to the last event of a train, s.
struct TrainSpan
{
    double first = 0.0;
    double last = 0.0;
    bool operator==(const TrainSpan&) const = default;
};

/// The trains of at least five events that are less than `reach` s apart, each about as strong and as far from the next
/// as its neighbours: a machine, a roll, a ratchet. Rain and crackling are as dense, but uneven. `onsets` in order of
/// time; so are the trains, which do not overlap. The limits are choices.
[[nodiscard]] inline std::vector<TrainSpan> evenTrains(std::span<const Onset> onsets, double reach)
{
    constexpr double alike = 0.7; // smaller over larger
    constexpr std::size_t fewest = 5;
    const auto isNear = [](double a, double b)
    {
        return std::min(a, b) >= alike * std::max(a, b);
    };
    std::vector<TrainSpan> trains;
    std::size_t first = 0; // event of the train so far
    const auto end = [&](std::size_t last)
    {
        if (last - first + 1 >= fewest)
            trains.push_back({onsets[first].time, onsets[last].time});
        first = last;
    };
    for (std::size_t i = 1; i < onsets.size(); ++i)
    {
        const double gap = onsets[i].time - onsets[i - 1].time;
        if (gap >= reach || !isNear(onsets[i].amplitude, onsets[i - 1].amplitude))
        {
            end(i - 1);
            first = i;
        }
        else if (i > first + 1 && !isNear(gap, onsets[i - 1].time - onsets[i - 2].time))
            end(i - 1); // which may begin the next
    }
    if (!onsets.empty())
        end(onsets.size() - 1);
    return trains;
}

} // namespace pacini
