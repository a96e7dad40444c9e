#pragma once

// Model selection for an equaliser: finds the number and the types of its sections.

#include <pacini/linearize/EqualizerFitProblem.h>
#include <pacini/linearize/EqualizerRefinement.h>
#include <pacini/linearize/EqualizerStart.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace pacini
{

/// Finds places where the points of a problem are too sparse for the sections of a fit, and adds guards.
class EqualizerWatch
{
public:
    explicit EqualizerWatch(EqualizerFitProblem& watched) : problem(watched)
    {
        constexpr double octaves = 1.0 / 32.0;
        constexpr int reach = 112;
        const std::size_t n = problem.points();
        for (int i = 1; i <= reach; ++i)
        {
            below.add(problem, problem.frequency[0] * std::exp2(-octaves * i));
            above.add(problem, problem.frequency[n - 1] * std::exp2(octaves * i));
        }
        for (std::size_t i = 0; i + 1 < n; ++i)
            between.add(problem, std::sqrt(problem.frequency[i] * problem.frequency[i + 1]));
    }

    /// Adds guards where the sections are sharp, at their poles and zeros, and at the highest point between the points
    /// and of each side of the range up to 3.5 octaves away, where no measured point holds a section.
    void guard(const EqualizerSections& sections)
    {
        for (const EqualizerSection& section : sections)
        {
            // the poles and zeros of a shelf lie at sqrt(A) to both sides, those of a peak on it
            const double apart = section.type == EqualizerType::peak ? 1.0 : std::pow(10.0, section.gain / 80.0);
            problem.addGuard(section.frequency * apart);
            if (apart != 1.0)
                problem.addGuard(section.frequency / apart);
        }
        for (const Grid* grid : {&below, &between, &above})
            guardHighest(*grid, sections);
    }

private:
    struct Grid
    {
        std::vector<double> frequency, warped, fixed; ///< Hz, warpedSquare(), power of the high-pass

        void add(const EqualizerFitProblem& fitted, double f)
        {
            if (f >= fitted.highestGuard())
                return;
            frequency.push_back(f);
            warped.push_back(warpedSquare(f, fitted.fs));
            const double gain = fitted.highpass ? Decibels(fitted.fixedAt(f)).gain() : 1.0;
            fixed.push_back(gain * gain);
        }
    };

    void guardHighest(const Grid& grid, const EqualizerSections& sections)
    {
        if (grid.frequency.empty())
            return;
        power = grid.fixed;
        for (const EqualizerSection& section : sections)
            SectionCurve(section, problem.fs).multiply(grid.warped, power);
        const auto highest = std::max_element(power.begin(), power.end()) - power.begin();
        problem.addGuard(grid.frequency[static_cast<std::size_t>(highest)]);
    }

    EqualizerFitProblem& problem;
    Grid below, between, above;
    std::vector<double> power;
};

/// Flatness of response and sections together.
struct Flatness
{
    double level = 0.0; ///< dB, their mean
    double rms = 0.0;   ///< dB from that
    double max = 0.0;   ///< dB, largest at a point of weight above 0
};

/// The flatness of the level at the points of a problem plus `curve` (dB, at least as many), weighted.
[[nodiscard]] inline Flatness flatnessOf(const EqualizerFitProblem& problem, const std::vector<double>& curve,
                                         const std::vector<double>& weight)
{
    Flatness flatness;
    double weights = 0.0;
    for (std::size_t i = 0; i < problem.points(); ++i)
    {
        flatness.level += weight[i] * (problem.level[i] + curve[i]);
        weights += weight[i];
    }
    flatness.level /= weights;
    double squares = 0.0;
    for (std::size_t i = 0; i < problem.points(); ++i)
    {
        const double deviation = problem.level[i] + curve[i] - flatness.level;
        squares += weight[i] * deviation * deviation;
        if (weight[i] > 0.0)
            flatness.max = std::max(flatness.max, std::abs(deviation));
    }
    flatness.rms = std::sqrt(squares / weights);
    return flatness;
}

/// Adds one section after the other: of some proposals the one that is best after a few steps of refinement of all
/// sections together, since what looks best alone often is not. It ends when as many are there as were wanted, when the
/// goal is reached (if their number is free), when nothing is left to flatten, or when two in a row do not lower the
/// Bayesian information criterion (G. Schwarz, "Estimating the dimension of a model", 1978): then they would follow the
/// noise. A section has three parameters; the criterion counts five, since the narrow section that fits the noise best
/// is the best of as many as there are points (as in the multiple testing of D. Foster and E. George, "The risk
/// inflation criterion for multiple regression", 1994: 2 ln n each for the choice).
class EqualizerSearch
{
public:
    EqualizerSearch(EqualizerFitProblem& fitted, const EqualizerFitParams& wanted)
        : problem(fitted),
          params(wanted),
          refinement(fitted),
          start(fitted),
          watch(fitted),
          most(std::min(static_cast<std::size_t>(wanted.sections.value_or(wanted.maxSections)),
                        (fitted.points() - 1) / 3)) // no more parameters than points
    {
    }

    /// The sections, without the fixed high-pass.
    [[nodiscard]] EqualizerSections run()
    {
        constexpr double nothing = 0.002; // dB, far below what can be measured
        constexpr int patience = 2;
        EqualizerCandidate now;
        Flatness flatness = assess(now);
        EqualizerCandidate best = now;
        double bestCriterion = criterion(now);
        int failures = 0;
        while (now.sections.size() < most && flatness.rms > nothing && !suffices(flatness) && failures < patience)
        {
            now = withOneMore(now);
            flatness = assess(now);
            const bool last = now.sections.size() == most || flatness.rms <= nothing;
            const bool nearGoal = !params.sections && flatness.rms < 3.0 * params.goalRms;
            if (last || nearGoal)
                flatness = finish(now, flatness);
            const double reached = criterion(now);
            const bool better = reached < bestCriterion;
            failures = better ? 0 : failures + 1;
            if (better || suffices(flatness))
            {
                best = now;
                bestCriterion = reached;
            }
        }
        if (best.sections.size() < now.sections.size())
            finish(best, assess(best));
        return best.sections;
    }

    [[nodiscard]] int iterations() const noexcept { return refinement.iterations(); }

private:
    [[nodiscard]] bool suffices(const Flatness& flatness) const
    {
        return !params.sections && flatness.rms <= params.goalRms && flatness.max <= params.goalMax;
    }

    /// The flatness, drop-outs aside; brings the candidate's level and cost up to date.
    Flatness assess(EqualizerCandidate& candidate)
    {
        const Flatness flatness = flatnessOf(problem, refinement.evaluate(candidate.sections), problem.weight);
        candidate.level = flatness.level;
        candidate.cost = refinement.cost(candidate.level);
        return flatness;
    }

    [[nodiscard]] double criterion(const EqualizerCandidate& candidate) const
    {
        constexpr double parameters = 5.0; // per section, see above
        constexpr double smallest = 1e-12; // dB^2, so that a perfect fit has a logarithm
        const auto n = static_cast<double>(problem.points());
        return n * std::log(candidate.cost / n + smallest) +
               parameters * static_cast<double>(candidate.sections.size()) * std::log(n);
    }

    [[nodiscard]] EqualizerCandidate withOneMore(const EqualizerCandidate& from)
    {
        constexpr int trialSteps = 3;
        constexpr int steps = 4;
        const std::vector<double>& curve = refinement.evaluate(from.sections);
        std::vector<double> deviation(problem.points());
        for (std::size_t i = 0; i < deviation.size(); ++i)
            deviation[i] = problem.level[i] + curve[i] - from.level;
        EqualizerCandidate best;
        for (const EqualizerSection& proposal : start.proposals(deviation))
        {
            EqualizerCandidate candidate = from;
            candidate.sections.pushBack(proposal);
            assess(candidate);
            refinement.refine(candidate, trialSteps);
            if (best.sections.empty() || candidate.cost < best.cost)
                best = candidate;
        }
        refinement.refine(best, steps);
        return best;
    }

    /// Fits to the end, by Huber's loss as soon as it is noise that is left: before, a resonance that no section has
    /// taken up yet would count as an outlier. Returns the flatness.
    Flatness finish(EqualizerCandidate& candidate, const Flatness& before)
    {
        if (before.rms < 3.0 * problem.noise)
            problem.outlier = 2.5 * problem.noise;
        const int steps = 6 * static_cast<int>(candidate.sections.size() + 1);
        refinement.refine(candidate, steps);
        keepLimits(candidate);
        problem.outlier = std::numeric_limits<double>::infinity();
        return assess(candidate);
    }

    /// Raises the penalty until the limits of the boost hold; if they never do, all gains fall until they do.
    void keepLimits(EqualizerCandidate& candidate)
    {
        constexpr double tolerance = 0.05; // dB
        constexpr int rounds = 4;
        constexpr int steps = 12;
        double penalty = EqualizerRefinement::usualPenalty;
        const auto exceeds = [&]
        {
            watch.guard(candidate.sections);
            refinement.evaluate(candidate.sections);
            return refinement.largestExcess() > tolerance;
        };
        bool exceeding = exceeds();
        for (int i = 0; i < rounds && exceeding; ++i)
        {
            penalty *= 5.0;
            refinement.setPenalty(penalty);
            refinement.refine(candidate, steps);
            exceeding = exceeds();
        }
        refinement.setPenalty(EqualizerRefinement::usualPenalty);
        while (exceeding)
        {
            for (EqualizerSection& section : candidate.sections)
                section.gain *= 0.95;
            exceeding = exceeds();
        }
    }

    EqualizerFitProblem& problem;
    const EqualizerFitParams& params;
    EqualizerRefinement refinement;
    EqualizerStart start;
    EqualizerWatch watch;
    std::size_t most;
};

} // namespace pacini
