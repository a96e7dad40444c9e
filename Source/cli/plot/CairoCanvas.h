#pragma once

// Canvas for PNG and PDF, on cairo.

#include "cli/plot/Canvas.h"

namespace pacini::plot
{

class CairoCanvas : public Canvas
{
public:
    /// A picture of `width` x `height` pixels.
    [[nodiscard]] static std::unique_ptr<Canvas> png(int width, int height);

    /// One page; a pixel is 1/96 inch.
    [[nodiscard]] static std::unique_ptr<Canvas> pdf(int width, int height, const std::string& title);

    ~CairoCanvas() override;

    void draw(const Path& path, const Paint& paint) override;
    void text(Point at, std::string_view what, const TextStyle& style) override;
    [[nodiscard]] double textWidth(std::string_view what, const TextStyle& style) const override;
    void beginGroup(std::string_view name, const std::optional<Rectangle>& clip) override;
    void endGroup() override;
    [[nodiscard]] Result<std::string> finish() override;

private:
    struct State;
    explicit CairoCanvas(std::unique_ptr<State> started);
    std::unique_ptr<State> state;
};

} // namespace pacini::plot
