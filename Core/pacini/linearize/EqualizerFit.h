#pragma once

// Equalizer fit: the sections that flatten a measured response.

#include <pacini/linearize/EqualizerSearch.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pacini
{

/// The peaks and shelves, in order of frequency, that make the response as flat as can be at the rate at which they
/// will run, the cramping of the bilinear transform included. Deterministic. Drop-outs, single points far from both
/// neighbours, are left out of the fit but count in the result's rms and max, which are computed anew from the sections
/// returned. No frequency is raised above maxBoost + 0.1 dB, nor, unless boostOutside, any outside of the range by more
/// than at its edge + 0.1 dB; so what is too weak is not raised, but the rest is lowered. With more than 1024 points in
/// the range the fit takes their means over 1024 steps of equal ratio. Errors as validate() has them, and when fewer
/// than 8 points of weight above 0 remain.
///
/// The sections are found by adding one after the other (EqualizerSearch) and moving all of them together
/// (EqualizerRefinement). Sections are what actuators are made of, so that few do: a mass on a spring takes two. A
/// response of fewer points than 3 per section gets fewer sections.
[[nodiscard]] inline Result<EqualizerFit> fitEqualizer(const FrequencyResponse& response,
                                                       const EqualizerFitParams& params = {})
{
    const auto whole = makeEqualizerFitProblem(response, params);
    if (!whole)
        return whole.error();
    EqualizerFitProblem problem = thinned(*whole);
    EqualizerSearch search(problem, params);
    std::vector<EqualizerSection> found;
    for (const EqualizerSection& section : search.run())
    {
        constexpr double nothing = 0.001; // dB
        if (std::abs(section.gain) >= nothing)
            found.push_back(section);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const EqualizerSection& a, const EqualizerSection& b) { return a.frequency < b.frequency; });

    EqualizerFit fit;
    if (params.highpass)
        fit.sections.pushBack(*params.highpass);
    EqualizerSections moving;
    for (const EqualizerSection& section : found)
    {
        fit.sections.pushBack(section);
        moving.pushBack(section);
    }
    const std::vector<double> watched = EqualizerRefinement(problem).evaluate(moving);
    fit.boost = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < watched.size(); ++i)
        fit.boost = std::max(fit.boost, watched[i] + problem.fixed[i]);

    const std::vector<double> curve = EqualizerRefinement(*whole).evaluate(moving);
    const Flatness flatness = flatnessOf(*whole, curve, whole->given);
    const Flatness withoutDropouts = flatnessOf(*whole, curve, whole->weight);
    fit.rms = flatness.rms;
    fit.max = flatness.max;
    fit.level = flatness.level;
    fit.points = whole->points();
    fit.dropouts = whole->dropouts;
    fit.iterations = search.iterations();
    fit.reachedGoal = withoutDropouts.rms <= params.goalRms && withoutDropouts.max <= params.goalMax;
    return fit;
}

} // namespace pacini
