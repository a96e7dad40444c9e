#pragma once

// Panel of a figure: one pair of axes with its series and legend.

#include "cli/plot/Axis.h"
#include "cli/plot/Series.h"
#include "cli/plot/Theme.h"

#include <string>
#include <vector>

namespace pacini::plot
{

/// Sizes in pixels that all texts and gaps of a figure follow from.
struct Metrics
{
    explicit Metrics(double textSize) : text(textSize) {}

    double text; ///< size of ordinary text

    [[nodiscard]] double title() const noexcept { return 1.5 * text; }
    [[nodiscard]] double line() const noexcept { return 1.45 * text; } ///< distance of lines of text
    [[nodiscard]] double gap() const noexcept { return 0.5 * text; }
    [[nodiscard]] double hair() const noexcept { return text / 13.0; } ///< width of thin lines
};

/// Colours and sizes to draw with.
struct Look
{
    Theme theme = lightTheme();
    Metrics metrics{13.0};
};

enum class LegendPlace
{
    none,
    above, ///< in one row at the right end of the title's line
    right, ///< in a column beside the plot
};

/// A vertical line through a panel.
struct Rule
{
    double x = 0.0;
    std::string label; ///< at its upper end; left out where there is no room
};

struct Panel
{
    std::string title; ///< above the plot, at its left end
    Axis x;
    Axis y;
    std::vector<Series> series; ///< the later in front
    std::vector<Rule> rules{};
    std::vector<Tick> rightLabels{}; ///< texts beside the plot at values of y
    LegendPlace legend = LegendPlace::above;
    bool crossGrid = true; ///< grid lines also at the ticks of y
    double share = 1.0;    ///< of the height of a figure, in relation to the other panels
};

/// Pixels that a panel needs around its plot.
struct Margins
{
    double left = 0.0;
    double right = 0.0;
    double top = 0.0;
    double bottom = 0.0;
};

/// The margins of a panel whose plot is `height` pixels high; `withX`: with labels and title of the x axis.
[[nodiscard]] Margins marginsOf(const Canvas& canvas, const Panel& panel, double height, bool withX, const Look& look);

/// Draws a panel; its plot fills `plot`, the rest goes into the margins.
void drawPanel(Canvas& canvas, const Panel& panel, const Rectangle& plot, const Margins& margins, bool withX,
               const Look& look);

} // namespace pacini::plot
