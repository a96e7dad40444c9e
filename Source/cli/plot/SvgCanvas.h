#pragma once

// A canvas for SVG. Written by hand and not by cairo, which would turn every letter into an outline: texts can be
// searched, edited and read aloud, and the title of its group names each curve.

#include "cli/plot/FontMetrics.h"

#include <cstddef>

namespace pacini::plot
{

class SvgCanvas : public Canvas
{
public:
    SvgCanvas(int width, int height, std::string_view title);

    void draw(const Path& path, const Paint& paint) override;
    void text(Point at, std::string_view what, const TextStyle& style) override;
    [[nodiscard]] double textWidth(std::string_view what, const TextStyle& style) const override;
    void beginGroup(std::string_view name, const std::optional<Rectangle>& clip) override;
    void endGroup() override;
    [[nodiscard]] Result<std::string> finish() override;

private:
    FontMetrics metrics;
    std::string content;
    std::size_t clips = 0;
};

} // namespace pacini::plot
