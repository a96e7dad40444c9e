#pragma once

// Edits of transients. Pure functions; times are clamped to the clip, amplitudes and sharpness to their ranges, numbers
// that are not finite change nothing, and indices beyond the list are ignored.

#include <pacini/clip/edits/RangeEdits.h>
#include <pacini/clip/edits/Selection.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace pacini
{

namespace detail
{
[[nodiscard]] inline Transient limitedTransient(const Transient& event, double duration) noexcept
{
    return {clampTo(event.time, 0.0, duration), clampTo(event.amplitude, 0.0, limits::amplitude),
            clampTo(event.sharpness, 0.0, 1.0)};
}
} // namespace detail

/// Adds a transient, behind those at its time.
[[nodiscard]] inline Clip addTransient(Clip clip, const Transient& event)
{
    if (!std::isfinite(event.time) || !std::isfinite(event.amplitude) || !std::isfinite(event.sharpness))
        return clip;
    const Transient added = detail::limitedTransient(event, clip.duration);
    clip.transients.insert(std::upper_bound(clip.transients.begin(), clip.transients.end(), added.time,
                                            [](double t, const Transient& other) { return t < other.time; }),
                           added);
    return clip;
}

/// Removes transients.
[[nodiscard]] inline Clip deleteTransients(Clip clip, const Indices& selection)
{
    std::vector<Transient> kept;
    for (std::size_t i = 0; i < clip.transients.size(); ++i)
        if (!std::binary_search(selection.begin(), selection.end(), i))
            kept.push_back(clip.transients[i]);
    clip.transients = std::move(kept);
    return clip;
}

/// Keeps the strongest transients of a range so that no two of them are closer than `gap` seconds (skin resolves about
/// 8 to 10 ms); of equal ones the earlier. None whose amplitude is below `weakest` is kept. Those outside the range
/// stay and keep no others away.
[[nodiscard]] inline Clip thinTransients(Clip clip, TimeRange range, double gap, double weakest = 0.0)
{
    const TimeRange within = withinClip(range, clip.duration);
    Indices byStrength;
    std::vector<bool> kept(clip.transients.size(), true);
    for (std::size_t i = 0; i < clip.transients.size(); ++i)
        if (detail::isInside(within, clip.transients[i].time))
        {
            kept[i] = false;
            if (clip.transients[i].amplitude >= weakest)
                byStrength.push_back(i);
        }
    std::stable_sort(byStrength.begin(), byStrength.end(),
                     [&](std::size_t a, std::size_t b)
                     { return clip.transients[a].amplitude > clip.transients[b].amplitude; });
    const auto crowded = [&](std::size_t i, std::size_t other)
    {
        return std::abs(clip.transients[i].time - clip.transients[other].time) < gap;
    };
    for (std::size_t i : byStrength)
    {
        bool free = true;
        for (std::size_t j = i; free && j-- > 0 && crowded(i, j);)
            free = !(kept[j] && detail::isInside(within, clip.transients[j].time));
        for (std::size_t j = i + 1; free && j < kept.size() && crowded(i, j); ++j)
            free = !(kept[j] && detail::isInside(within, clip.transients[j].time));
        kept[i] = free;
    }
    std::vector<Transient> left;
    for (std::size_t i = 0; i < kept.size(); ++i)
        if (kept[i])
            left.push_back(clip.transients[i]);
    clip.transients = std::move(left);
    return clip;
}

} // namespace pacini
