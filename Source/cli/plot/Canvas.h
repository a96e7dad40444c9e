#pragma once

// Canvas: interface for drawing figures and saving them in any picture format.

#include "cli/plot/Colour.h"
#include "cli/plot/Path.h"

#include <pacini/foundation/Result.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace pacini::plot
{

/// Line style of a path.
struct Stroke
{
    Colour colour;
    double width = 1.0; ///< pixels
    double dash = 0.0;  ///< length of dashes and of the gaps between them in pixels; 0 = unbroken
    bool round = true;  ///< ends and corners; round ends make a dot of a segment without length
};

/// Fill and outline of a path.
struct Paint
{
    std::optional<Colour> fill;
    std::optional<Stroke> stroke;
};

enum class Align
{
    left,
    centre,
    right,
};

struct TextStyle
{
    Colour colour;
    double size = 13.0; ///< pixels
    bool bold = false;
    Align align = Align::left;
    bool upwards = false; ///< turned by 90 degrees, read from the right
};

/// Drawing surface; positions are pixels from the upper left corner. Texts are UTF-8; see printable().
class Canvas
{
public:
    virtual ~Canvas() = default;

    virtual void draw(const Path& path, const Paint& paint) = 0;

    /// `at` is on the baseline, at the left end, the middle or the right end of the text.
    virtual void text(Point at, std::string_view what, const TextStyle& style) = 0;

    /// Pixels from the start of the text to its end.
    [[nodiscard]] virtual double textWidth(std::string_view what, const TextStyle& style) const = 0;

    /// Starts a group, up to endGroup(), clipped to `clip` if given. Formats that support it keep the name. Groups may
    /// contain groups.
    virtual void beginGroup(std::string_view name, const std::optional<Rectangle>& clip = {}) = 0;
    virtual void endGroup() = 0;

    /// The bytes of the picture's file. Call once, last. Errors: tooLarge, io.
    [[nodiscard]] virtual Result<std::string> finish() = 0;
};

/// Returns `text` in a form that can be shown and stored: invalid UTF-8 and control characters become U+FFFD.
[[nodiscard]] std::string printable(std::string_view text);

/// `text`, or as much of its start as fits into `width` pixels with an ellipsis.
[[nodiscard]] std::string shortened(const Canvas& canvas, std::string_view text, const TextStyle& style, double width);

} // namespace pacini::plot
