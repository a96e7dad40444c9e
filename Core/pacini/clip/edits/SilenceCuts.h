#pragma once

// Scenes of a long clip: cuts in its silences.

#include <pacini/clip/edits/TimeEdits.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pacini
{

struct SilenceCutParams
{
    double shortestScene = 10.0;  ///< s; more than 0
    double shortestSilence = 0.5; ///< s that are silent around a cut
    double level = 0.01;          ///< full drive = 1: -40 dB; silence is at most so strong
};

namespace detail
{
/// Stretches of `curve`, linear between its points, that are at most `level`, from 0 to `duration` s.
[[nodiscard]] inline std::vector<TimeRange> quietRanges(const Curve& curve, double level, double duration)
{
    if (curve.empty())
        return {{0.0, duration}};
    std::vector<TimeRange> quiet;
    const auto add = [&](double from, double to)
    {
        if (!quiet.empty() && quiet.back().to >= from)
            quiet.back().to = std::max(quiet.back().to, to);
        else if (to > from)
            quiet.push_back({from, to});
    };
    if (curve.front().value <= level)
        add(0.0, curve.front().time);
    for (std::size_t i = 1; i < curve.size(); ++i)
    {
        const Breakpoint a = curve[i - 1], b = curve[i];
        const bool beginsQuiet = a.value <= level, endsQuiet = b.value <= level;
        if (!beginsQuiet && !endsQuiet)
            continue;
        const double crossing =
            beginsQuiet == endsQuiet ? b.time : a.time + (b.time - a.time) * (level - a.value) / (b.value - a.value);
        add(beginsQuiet ? a.time : crossing, endsQuiet ? b.time : crossing);
    }
    if (curve.back().value <= level)
        add(curve.back().time, duration);
    return quiet;
}
} // namespace detail

/// The scenes of a clip, in order: together all of it, each cut off in the middle of a silence of its envelope without
/// events. A clip without such silences is one scene. O(points + events).
[[nodiscard]] inline std::vector<TimeRange> scenesOf(const Clip& clip, const SilenceCutParams& params = {})
{
    constexpr double before = 0.05, behind = 0.2; // s around an event that are felt
    const Curve envelope = clip.envelope.empty() ? detail::impliedEnvelope(clip) : clip.envelope;
    std::vector<TimeRange> scenes;
    double start = 0.0;
    const auto tryToCut = [&](double from, double to)
    {
        const double middle = 0.5 * (from + to);
        if (to - from < params.shortestSilence || middle - start < params.shortestScene ||
            clip.duration - middle < params.shortestScene)
            return;
        scenes.push_back({start, middle});
        start = middle;
    };
    std::size_t event = 0;
    for (const TimeRange& quiet : detail::quietRanges(envelope, params.level, clip.duration))
    {
        double from = quiet.from;
        while (event < clip.transients.size() && clip.transients[event].time + behind <= quiet.from)
            ++event;
        for (std::size_t i = event; i < clip.transients.size() && clip.transients[i].time - before < quiet.to; ++i)
        {
            tryToCut(from, clip.transients[i].time - before);
            from = std::max(from, clip.transients[i].time + behind);
        }
        tryToCut(from, quiet.to);
    }
    scenes.push_back({start, clip.duration});
    return scenes;
}

} // namespace pacini
