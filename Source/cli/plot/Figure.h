#pragma once

// Figure: one or more panels above each other, most with the same x axis, drawn on a canvas.

#include "cli/plot/Panel.h"
#include "cli/plot/PictureFile.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pacini::plot
{

struct Figure
{
    std::string title;
    std::string subtitle;      ///< in smaller letters below; may be empty
    std::vector<Panel> panels; ///< from above; the lowest of those with the same x axis shows its labels
};

/// Size of a figure, and whether its ground is dark.
struct FigureStyle
{
    PictureSize size;
    bool dark = false;
};

/// Texts are 15 pixels high in a picture of 1600 x 1000; they grow in proportion and shrink by the square root only, to
/// stay readable.
[[nodiscard]] Look lookFor(const FigureStyle& style);

/// Fills the canvas with the figure.
void drawFigure(Canvas& canvas, const Figure& figure, const FigureStyle& style);

/// Draws the figure into a file; returns its size in bytes. Errors as in writePicture.
[[nodiscard]] Result<std::size_t> writeFigure(const std::filesystem::path& path, const Figure& figure,
                                              const FigureStyle& style, Replaceable replaceable = Replaceable::named);

} // namespace pacini::plot
