#pragma once

// Levenberg-Marquardt refinement: moves equalizer sections to the nearest least-squares fit.

#include <pacini/foundation/Units.h>
#include <pacini/linearize/EqualizerFitProblem.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace pacini
{

/// Peaks and shelves, and the level that response and sections together are meant to have.
struct EqualizerCandidate
{
    EqualizerSections sections;
    double level = 0.0; ///< dB
    double cost = std::numeric_limits<double>::infinity();
};

/// Levenberg-Marquardt (D. Marquardt, "An algorithm for least-squares estimation of nonlinear parameters", 1963) on
/// ln(frequency), gain and ln(q) of all sections at once and on the level, with the derivatives of SectionCurve and the
/// damping of H. B. Nielsen, "Damping parameter in Marquardt's method", IMM-REP-1999-05. Frequency and q go by their
/// logarithms, since their effect is about the same at the same ratio. The cost is the sum over the points of
/// weight * rho(response + sections - level), rho that of P. J. Huber, "Robust estimation of a location parameter",
/// 1964, plus `penalty` times the squares of what exceeds a limit of the boost. Of a shelf only the shape counts, since
/// the level is free, so that all shelves are kept as such that lower one side.
class EqualizerRefinement
{
public:
    static constexpr double usualPenalty = 100.0; ///< holds the limits within about 0.1 dB
    static constexpr double maxCut = 39.9;        ///< dB, of a section; a valid one has at most 40

    explicit EqualizerRefinement(const EqualizerFitProblem& fitted) : problem(fitted) {}

    /// The level of the sections at all points, dB; valid until the next call of anything here.
    const std::vector<double>& evaluate(const EqualizerSections& sections)
    {
        curve.assign(problem.allPoints(), 1.0);
        for (const EqualizerSection& section : sections)
            SectionCurve(section, problem.fs).multiply(problem.warped, curve);
        for (double& value : curve)
            value = Decibels::fromPower(value).value;
        return curve;
    }

    /// The cost at the last call of evaluate().
    [[nodiscard]] double cost(double level) const
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < problem.points(); ++i)
        {
            const double deviation = problem.level[i] + curve[i] - level;
            const double size = std::abs(deviation);
            sum += problem.weight[i] *
                   (size <= problem.outlier ? deviation * deviation : problem.outlier * (2.0 * size - problem.outlier));
        }
        double excess = 0.0;
        forEachExcess([&](std::size_t, std::ptrdiff_t, double over) { excess += over * over; });
        return sum + penalty * excess;
    }

    /// The largest excess over a limit of the boost, dB.
    [[nodiscard]] double largestExcess() const
    {
        double most = 0.0;
        forEachExcess([&](std::size_t, std::ptrdiff_t, double over) { most = std::max(most, over); });
        return most;
    }

    void setPenalty(double factor) noexcept { penalty = factor; }

    /// Steps so far.
    [[nodiscard]] int iterations() const noexcept { return steps; }

    /// Improves the candidate by up to `maxSteps` steps; ends before when two in a row gain less than 0.1 %. Its cost
    /// never rises, and its sections stay within the bounds of the problem.
    void refine(EqualizerCandidate& candidate, int maxSteps)
    {
        constexpr double enough = 1e-3;
        lowerShelves(candidate);
        evaluate(candidate.sections);
        double damping = 1e-2;
        double growth = 2.0;
        int smallGains = 0;
        bool moved = true;
        for (int i = 0; i < maxSteps && smallGains < 2 && damping < 1e7; ++i)
        {
            if (moved)
                linearise(candidate);
            ++steps;
            solve(damping);
            EqualizerCandidate trial = movedFrom(candidate);
            evaluate(trial.sections);
            trial.cost = cost(trial.level);
            const double gained = candidate.cost - trial.cost;
            moved = gained > 0.0;
            if (!moved)
            {
                damping *= growth;
                growth *= 2.0;
                continue;
            }
            const double promised = -2.0 * step.dot(gradient) - step.dot(normal.selfadjointView<Eigen::Lower>() * step);
            const double trust = 2.0 * gained / std::max(promised, gained) - 1.0;
            damping = std::max(1e-9, damping * std::max(0.2, 1.0 - trust * trust * trust));
            growth = 2.0;
            smallGains = gained <= enough * candidate.cost ? smallGains + 1 : 0;
            candidate = trial;
            if (lowerShelves(candidate))
                evaluate(candidate.sections);
        }
    }

private:
    using Index = Eigen::Index;

    /// Normal equations at the candidate, whose curve was evaluated last.
    void linearise(EqualizerCandidate& candidate)
    {
        const std::size_t n = problem.points();
        const auto rows = static_cast<Index>(n);
        const auto columns = static_cast<Index>(3 * candidate.sections.size() + 1);
        const Index last = columns - 1;
        slopes.resize(static_cast<Index>(problem.allPoints()), last);
        for (std::size_t k = 0; k < candidate.sections.size(); ++k)
        {
            const auto column = [&](std::size_t c)
            {
                return std::span(slopes.col(static_cast<Index>(3 * k + c)).data(), problem.allPoints());
            };
            SectionCurve(candidate.sections[k], problem.fs)
                .differentiate(problem.warped, SectionSlopes{column(0), column(1), column(2)});
        }

        weighted.resize(rows, columns);
        residual.resize(rows);
        for (std::size_t i = 0; i < n; ++i)
        {
            const auto row = static_cast<Index>(i);
            const double deviation = problem.level[i] + curve[i] - candidate.level;
            const double size = std::abs(deviation);
            const double share = size <= problem.outlier ? 1.0 : problem.outlier / size;
            const double root = std::sqrt(problem.weight[i] * share);
            residual[row] = root * deviation;
            weighted(row, last) = -root;
        }
        for (Index c = 0; c < last; ++c)
            weighted.col(c) = -weighted.col(last).cwiseProduct(slopes.col(c).head(rows));
        normal.setZero(columns, columns);
        normal.selfadjointView<Eigen::Lower>().rankUpdate(weighted.transpose());
        gradient.noalias() = weighted.transpose() * residual;
        forEachExcess(
            [&](std::size_t i, std::ptrdiff_t edge, double over)
            {
                step.setZero(columns);
                step.head(last) = slopes.row(static_cast<Index>(i));
                if (edge >= 0)
                    step.head(last) -= slopes.row(static_cast<Index>(edge));
                normal.selfadjointView<Eigen::Lower>().rankUpdate(step, penalty);
                gradient += penalty * over * step;
            });
        candidate.cost = cost(candidate.level);
        holdAtBounds(candidate.sections);
    }

    void solve(double damping)
    {
        damped = normal;
        for (Index i = 0; i < damped.rows(); ++i)
            damped(i, i) += damping * normal(i, i) + 1e-9; // a section of 0 dB has no slope by frequency and q
        const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>, Eigen::Lower> factors(damped);
        step = -gradient;
        factors.solveInPlace(step);
    }

    /// Calls use(point, edge, dB) for every limit that is exceeded; the limit moves with the level at the point `edge`
    /// unless that is -1. The equalizer must not raise more than maxBoost, and outside of the range not more than at
    /// the edge of the range.
    template <typename Use>
    void forEachExcess(const Use& use) const
    {
        constexpr double margin = 0.03; // dB, which the penalty gives away
        const std::size_t n = problem.points();
        const double most = problem.maxBoost - margin;
        const auto boostAt = [&](std::size_t i)
        {
            return curve[i] + problem.fixed[i];
        };
        for (std::size_t i = 0; i < problem.allPoints(); ++i)
        {
            const double boost = boostAt(i);
            if (boost <= 0.0)
                continue;
            if (boost > most)
                use(i, -1, boost - most);
            const double f = problem.frequency[i];
            if (problem.boostOutside || (f >= problem.frequency[0] && f <= problem.frequency[n - 1]))
                continue;
            const std::size_t edge = f < problem.frequency[0] ? 0 : n - 1;
            const double allowed = std::max(0.0, boostAt(edge));
            if (boost > allowed)
                use(i, allowed > 0.0 ? static_cast<std::ptrdiff_t>(edge) : -1, boost - allowed);
        }
    }

    /// Replaces a shelf that raises one side by that which lowers the other: the same shape at a lower level.
    static bool lowerShelves(EqualizerCandidate& candidate)
    {
        bool changed = false;
        for (EqualizerSection& section : candidate.sections)
            if (section.type != EqualizerType::peak && section.gain > 0.0)
            {
                section.type =
                    section.type == EqualizerType::lowShelf ? EqualizerType::highShelf : EqualizerType::lowShelf;
                candidate.level -= section.gain;
                section.gain = -section.gain;
                changed = true;
            }
        return changed;
    }

    /// A peak may raise somewhat more than all together, where others take that away again.
    [[nodiscard]] double highestGain(const EqualizerSection& section) const
    {
        constexpr double overlap = 3.0; // dB
        return section.type == EqualizerType::peak ? std::min(maxCut, problem.maxBoost + overlap) : maxCut;
    }

    /// Both corners of a shelf have its q: where one stands on a resonance, the other would ring outside of the range.
    /// Up to this q a wide peak undoes that.
    [[nodiscard]] double highestQ(const EqualizerSection& section) const
    {
        constexpr double ofShelves = 4.0;
        return section.type == EqualizerType::peak ? problem.highestQ : std::min(ofShelves, problem.highestQ);
    }

    /// Takes parameters that are at a bound and would go beyond out of the equations.
    void holdAtBounds(const EqualizerSections& sections)
    {
        const auto check = [&](std::size_t column, double value, double low, double high)
        {
            const auto i = static_cast<Index>(column);
            if (!((value <= low && gradient[i] > 0.0) || (value >= high && gradient[i] < 0.0)))
                return;
            normal.row(i).head(i).setZero();
            normal.col(i).tail(normal.rows() - i - 1).setZero();
            gradient[i] = 0.0;
        };
        for (std::size_t k = 0; k < sections.size(); ++k)
        {
            const EqualizerSection& section = sections[k];
            check(3 * k, section.frequency, problem.lowestFrequency, problem.highestFrequency);
            check(3 * k + 1, section.gain, -maxCut, highestGain(section));
            check(3 * k + 2, section.q, problem.lowestQ, highestQ(section));
        }
    }

    [[nodiscard]] EqualizerCandidate movedFrom(const EqualizerCandidate& from) const
    {
        EqualizerCandidate to = from;
        for (std::size_t k = 0; k < to.sections.size(); ++k)
        {
            EqualizerSection& section = to.sections[k];
            const auto moveOf = [&](std::size_t c, double most)
            {
                return std::clamp(step[static_cast<Index>(3 * k + c)], -most, most);
            };
            section.frequency = std::clamp(section.frequency * std::exp(moveOf(0, 0.7)), problem.lowestFrequency,
                                           problem.highestFrequency);
            section.gain = std::clamp(section.gain + moveOf(1, 20.0), -maxCut, highestGain(section));
            section.q = std::clamp(section.q * std::exp(moveOf(2, 1.0)), problem.lowestQ, highestQ(section));
        }
        to.level += step[step.size() - 1];
        return to;
    }

    const EqualizerFitProblem& problem;
    std::vector<double> curve;
    double penalty = usualPenalty;
    int steps = 0;
    Eigen::MatrixXd slopes, weighted, normal, damped;
    Eigen::VectorXd residual, gradient, step;
};

} // namespace pacini
