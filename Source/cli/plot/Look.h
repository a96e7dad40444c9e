#pragma once

// Drawing style of a figure: its colours and its sizes.

#include "cli/plot/Theme.h"

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

} // namespace pacini::plot
