#pragma once

// Culling: finds the plays and bands that a plan can do without.

#include <pacini/actuator/EqualizerPruning.h>
#include <pacini/foundation/Result.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/PlayEnergy.h>
#include <pacini/synthesis/RenderPlan.h>
#include <pacini/synthesis/Scene.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace pacini::detail
{

/// Sum of errors. Parts of one sound that start together add in amplitude, others in power. The sum is raised by 1.5 dB
/// for chance correlations between different sounds.
class ErrorSum
{
public:
    using Key = std::tuple<std::size_t, double, double>; // clip, start, transposition

    [[nodiscard]] double with(const Key& key, double energy) const
    {
        const auto found = amplitudes.find(key);
        const double before = found == amplitudes.end() ? 0.0 : found->second;
        const double after = before + std::sqrt(energy);
        return margin * (power - before * before + after * after);
    }
    void add(const Key& key, double energy)
    {
        double& amplitude = amplitudes[key];
        power -= amplitude * amplitude;
        amplitude += std::sqrt(energy);
        power += amplitude * amplitude;
    }
    [[nodiscard]] double total() const { return margin * std::max(power, 0.0); }

private:
    static constexpr double margin = 1.41;
    std::map<Key, double> amplitudes;
    double power = 0.0;
};

inline double errorInDecibels(double energy, double whole)
{
    return energy > 0.0 && whole > 0.0 ? Decibels::fromPower(energy / whole).value
                                       : -std::numeric_limits<double>::infinity();
}

/// Candidate for culling: a whole play or one of its bands, and the largest error of skipping it.
struct Dispensable
{
    double energy;
    std::size_t planned;             ///< index into the plan's plays
    std::optional<std::size_t> band; ///< none: the whole play
};

/// Returns all plays of a plan and their bands, smallest error first. Whole plays come before bands: they save most,
/// and their bands would count twice.
inline std::vector<Dispensable> dispensables(const RenderPlan& plan, std::span<const PlayEnergy> energies)
{
    std::vector<Dispensable> candidates;
    for (std::size_t i = 0; i < plan.plays.size(); ++i)
    {
        candidates.push_back({energies[i].most, i, {}});
        const DecoderParams& decoder = plan.plays[i].decoder;
        if (decoder.carriers == CarrierMode::centroid || decoder.leftOut[Role::tones])
            continue; // bands are placed by the mean of all centres, or share an envelope unheard: each counts
        for (std::size_t k = 0; k < energies[i].bands.size(); ++k)
            candidates.push_back({energies[i].bands[k], i, k});
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Dispensable& a, const Dispensable& b)
                     { return a.band.has_value() != b.band.has_value() ? b.band.has_value() : a.energy < b.energy; });
    return candidates;
}

/// Takes the plays and bands out of a plan that are marked.
inline void removeMarked(RenderPlan& plan, const std::vector<bool>& plays, const std::vector<std::vector<bool>>& bands)
{
    std::vector<PlannedPlay> kept;
    for (std::size_t i = 0; i < plan.plays.size(); ++i)
    {
        if (plays[i])
            continue;
        PlannedPlay& planned = plan.plays[i];
        std::vector<Band> keptBands;
        for (std::size_t k = 0; k < planned.clip.bands.size(); ++k)
            if (!bands[i][k])
                keptBands.push_back(std::move(planned.clip.bands[k]));
        planned.clip.bands = std::move(keptBands);
        kept.push_back(std::move(planned));
    }
    plan.plays = std::move(kept);
}

/// Leaves out plays and bands, smallest error first, while the sum of the errors stays `tolerance` dB below `whole`,
/// the scene's energy. Returns the energy of the error.
inline double leaveOutWeak(RenderPlan& plan, const Scene& scene, std::span<const PlayEnergy> energies, double whole,
                           double tolerance)
{
    // An equaliser may take a quarter of the energy, which is half of the amplitude (leaveOutFlatSections).
    const double share = plan.profile && !plan.profile->equalizer.empty() ? 0.7 : 1.0;
    const double bearable = share * whole * Decibels(tolerance).power();
    ErrorSum error;
    std::vector<bool> playOut(plan.plays.size(), false);
    std::vector<std::vector<bool>> bandOut;
    for (const PlannedPlay& planned : plan.plays)
        bandOut.emplace_back(planned.clip.bands.size(), false);
    for (const Dispensable& candidate : dispensables(plan, energies))
    {
        if (playOut[candidate.planned])
            continue;
        const PlannedPlay& planned = plan.plays[candidate.planned];
        const ScenePlay& play = scene.plays[planned.play];
        const ErrorSum::Key key{play.clip, play.start, play.transposition};
        if (candidate.energy > 0.0 && error.with(key, candidate.energy) > bearable)
            continue;
        error.add(key, candidate.energy);
        std::string where = indexed("plays", planned.play);
        if (candidate.band)
        {
            bandOut[candidate.planned][*candidate.band] = true;
            where += indexed(".bands", *candidate.band);
        }
        else
            playOut[candidate.planned] = true;
        plan.leftOut.push_back({where, candidate.energy > 0.0 ? "is too weak to be perceived" : "is silent",
                                errorInDecibels(candidate.energy, whole)});
    }
    removeMarked(plan, playOut, bandOut);
    return error.total();
}

/// Leaves out the sections of the plan's equaliser that are flat where the actuator plays, for half of the tolerance
/// (dB). Returns the power of the error in parts of the signal's.
inline double leaveOutFlatSections(RenderPlan& plan, double tolerance, double sampleRate)
{
    // A deviation of some dB everywhere is an error of that part of all the energy.
    const double bearableGain = 1.0 + 0.5 * Decibels(tolerance).gain();
    PruningParams pruning;
    pruning.lowFrequency = Hertz(plan.profile->range.lowFrequency);
    pruning.highFrequency = Hertz(plan.profile->range.highFrequency);
    pruning.tolerance = Decibels(std::min(0.1, Decibels::fromGain(bearableGain).value / 4.0));
    const auto pruned = pruneEqualizer(plan.profile->equalizer, pruning, sampleRate);
    for (const DroppedSection& section : pruned.dropped)
        plan.leftOut.push_back({indexed("equalizer", section.index), "is flat in the actuator's range",
                                Decibels::fromGain(Decibels(section.deviation).gain() - 1.0 + 1e-30).value});
    plan.profile->equalizer = pruned.kept;
    return std::pow(Decibels(pruned.predictedError).gain() - 1.0, 2.0);
}

} // namespace pacini::detail
