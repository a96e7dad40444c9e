#pragma once

// Solo and mute while editing; the clip itself does not change.

#include <pacini/clip/Clip.h>
#include <pacini/clip/edits/TimeEdits.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

namespace pacini
{

/// The parts of a clip to play.
struct Audition
{
    std::set<std::size_t> solo;  ///< bands; when there are any, the others are silent
    std::set<std::size_t> muted; ///< bands
    bool transients = true;
    bool noise = true;
    bool operator==(const Audition&) const = default;

    [[nodiscard]] bool hears(std::size_t band) const
    {
        return !muted.contains(band) && (solo.empty() || solo.contains(band));
    }
};

/// Returns the clip as it is heard with solo and mute. The decoder levels the bands to the envelope, so the envelope is
/// lowered by the remaining share of the power: a soloed band is as loud as within the whole clip.
[[nodiscard]] inline Clip audibleClip(Clip clip, const Audition& audition)
{
    bool all = true;
    for (std::size_t k = 0; k < clip.bands.size(); ++k)
        all = all && audition.hears(k);
    if (!audition.transients)
        clip.transients.clear();
    if (!audition.noise)
        clip.noise.clear();
    if (all)
        return clip;
    const Curve whole = clip.envelope.empty() ? Curve{} : detail::impliedEnvelope(clip);
    for (std::size_t k = 0; k < clip.bands.size(); ++k)
        if (!audition.hears(k))
            clip.bands[k].amplitude.clear();
    if (clip.envelope.empty())
        return clip;
    const Curve rest = detail::impliedEnvelope(clip);
    std::vector<double> times;
    for (const Curve* curve : {static_cast<const Curve*>(&clip.envelope), &whole})
        for (const Breakpoint& p : *curve)
            times.push_back(p.time);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    CurveReader envelope(clip.envelope);
    CurveReader before(whole);
    CurveReader after(rest);
    Curve lowered;
    for (double time : times)
    {
        const double total = before.at(time);
        const double share = total > 0.0 ? std::min(1.0, after.at(time) / total) : 0.0;
        lowered.push_back({time, share * envelope.at(time)});
    }
    clip.envelope = std::move(lowered);
    return clip;
}

} // namespace pacini
