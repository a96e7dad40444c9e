#pragma once

// Figures of the results of a study.

#include "cli/plot/Figure.h"
#include "study/RatingAnalysis.h"
#include "study/statistics/Scaling.h"

#include <string>
#include <vector>

namespace pacini::cli
{

/// Box plots of the ratings of each stimulus, side by side for each group (Tukey 1977): quartiles, median, mean, the
/// last values within 1.5 quartile distances, and what lies beyond.
[[nodiscard]] plot::Figure boxPlots(const study::RatingAnalysis& analysis, const std::string& title,
                                    const plot::FigureStyle& style);

/// A value with its interval for each of some names.
struct NamedInterval
{
    std::string name;
    double value = 0.0;
    study::Interval interval;
};

/// Their points with bars, one below the name of each.
[[nodiscard]] plot::Figure intervalPlot(const std::vector<NamedInterval>& values, const std::string& title,
                                        const std::string& valueTitle, const plot::FigureStyle& style);

/// Right answers by what was asked.
struct PsychometricCurve
{
    std::string name;
    struct Answers
    {
        double value = 0.0; ///< of the variable
        std::size_t right = 0, trials = 0;
    };
    std::vector<Answers> answers;
    struct At
    {
        double value = 0.0;
        double share = 0.0; ///< that the fitted function gives
        study::Interval share95;
    };
    std::vector<At> fitted;
};

/// Fitted functions with their 95 % bands, and the shares that were seen, larger for more answers.
[[nodiscard]] plot::Figure psychometricPlot(const std::vector<PsychometricCurve>& curves, const std::string& title,
                                            const std::string& valueTitle, plot::Scale scale,
                                            const plot::FigureStyle& style);

/// Things at their places in a plane.
[[nodiscard]] plot::Figure mapPlot(const study::Scaling& scaling, const std::vector<std::string>& names,
                                   const std::string& title, const plot::FigureStyle& style);

/// The bytes of an SVG file of the figure.
[[nodiscard]] Result<std::string> svgOf(const plot::Figure& figure, const plot::FigureStyle& style);

} // namespace pacini::cli
