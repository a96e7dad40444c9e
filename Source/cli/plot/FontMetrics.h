#pragma once

// Font metrics: the width of texts.

#include "cli/plot/Canvas.h"

#include <memory>
#include <string_view>

namespace pacini::plot
{

/// Measures texts in the system's sans-serif font. Without any font cairo's built-in one is used, which knows ASCII
/// only. A build without cairo estimates.
class FontMetrics
{
public:
    FontMetrics();
    ~FontMetrics();
    FontMetrics(const FontMetrics&) = delete;
    FontMetrics& operator=(const FontMetrics&) = delete;

    [[nodiscard]] double textWidth(std::string_view what, const TextStyle& style) const;

private:
    struct State;
    std::unique_ptr<State> state;
};

} // namespace pacini::plot
