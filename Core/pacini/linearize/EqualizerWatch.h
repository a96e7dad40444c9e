#pragma once

// Where the boost of an equalizer has to be watched beside the measured points.

#include <pacini/linearize/EqualizerFitProblem.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pacini
{

/// Finds where the guard points of a problem are too far apart for the sections that a fit has come to, and adds more.
class EqualizerWatch
{
public:
    explicit EqualizerWatch(EqualizerFitProblem& watched) : problem(watched)
    {
        constexpr double octaves = 1.0 / 32.0;
        constexpr int reach = 112;
        const std::array edges = {problem.frequency[0], problem.frequency[problem.points() - 1]};
        for (std::size_t side = 0; side < edges.size(); ++side)
            for (int i = 1; i <= reach; ++i)
            {
                const double f = edges[side] * std::exp2((side == 0 ? -octaves : octaves) * i);
                if (f >= problem.highestGuard())
                    break;
                outside[side].frequency.push_back(f);
                outside[side].warped.push_back(warpedSquare(f, problem.fs));
            }
    }

    /// Adds guards where the sections are sharp, at their poles and zeros, and at the highest point of each side of the
    /// range up to 3.5 octaves away: a section is held by no measured point there.
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
        for (const Side& side : outside)
        {
            power.assign(side.warped.size(), 1.0);
            for (const EqualizerSection& section : sections)
                SectionCurve(section, problem.fs).multiply(side.warped, power);
            if (!power.empty())
                problem.addGuard(side.frequency[static_cast<std::size_t>(std::max_element(power.begin(), power.end()) -
                                                                         power.begin())]);
        }
    }

private:
    struct Side
    {
        std::vector<double> frequency, warped;
    };

    EqualizerFitProblem& problem;
    std::array<Side, 2> outside;
    std::vector<double> power;
};

} // namespace pacini
