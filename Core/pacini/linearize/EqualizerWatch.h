#pragma once

// Guard points of an equalizer fit: where its boost has to be watched beside the measured points.

#include <pacini/linearize/EqualizerFitProblem.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pacini
{

/// Finds where the points of a problem are too far apart for the sections that a fit has come to, and adds guards.
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

} // namespace pacini
