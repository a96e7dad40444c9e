#include "cli/plot/SvgCanvas.h"

#include "io/TableText.h"

#include <pacini/foundation/NumberText.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace pacini::plot
{

namespace
{
std::string escaped(std::string_view text)
{
    return xmlText(printable(text));
}

/// To a hundredth, without needless zeros.
std::string number(double value)
{
    return shortDecimalText(std::isfinite(value) ? value : 0.0, 2);
}

std::string colour(std::string_view attribute, const Colour& c)
{
    const auto part = [](double v)
    {
        return static_cast<int>(std::lround(255.0 * std::clamp(v, 0.0, 1.0)));
    };
    std::string text = fmt::format(" {}=\"#{:02x}{:02x}{:02x}\"", attribute, part(c.red), part(c.green), part(c.blue));
    if (c.alpha < 1.0)
        text += fmt::format(" {}-opacity=\"{}\"", attribute, number(c.alpha));
    return text;
}
} // namespace

SvgCanvas::SvgCanvas(int width, int height, std::string_view title)
{
    content = fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                          "viewBox=\"0 0 {0} {1}\" font-family=\"DejaVu Sans, Verdana, sans-serif\" role=\"img\">\n"
                          "<title>{2}</title>\n",
                          width, height, escaped(title));
}

void SvgCanvas::draw(const Path& path, const Paint& paint)
{
    if (path.empty())
        return;
    content += "<path d=\"";
    for (const Path::Step& step : path.all())
        switch (step.verb)
        {
        case Path::Verb::move:
            content += fmt::format("M{} {}", number(step.to.x), number(step.to.y));
            break;
        case Path::Verb::line:
            content += fmt::format("L{} {}", number(step.to.x), number(step.to.y));
            break;
        case Path::Verb::close:
            content += "Z";
            break;
        }
    content += "\"";
    content += paint.fill ? colour("fill", *paint.fill) : " fill=\"none\"";
    if (paint.stroke)
    {
        content += colour("stroke", paint.stroke->colour);
        content += fmt::format(" stroke-width=\"{}\"", number(paint.stroke->width));
        if (paint.stroke->round)
            content += " stroke-linecap=\"round\" stroke-linejoin=\"round\"";
        if (paint.stroke->dash > 0.0)
            content += fmt::format(" stroke-dasharray=\"{}\"", number(paint.stroke->dash));
    }
    content += "/>\n";
}

void SvgCanvas::text(Point at, std::string_view what, const TextStyle& style)
{
    content += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\"", number(at.x), number(at.y), number(style.size));
    content += colour("fill", style.colour);
    if (style.bold)
        content += " font-weight=\"bold\"";
    if (style.align != Align::left)
        content += style.align == Align::centre ? " text-anchor=\"middle\"" : " text-anchor=\"end\"";
    if (style.upwards)
        content += fmt::format(" transform=\"rotate(-90 {} {})\"", number(at.x), number(at.y));
    content += fmt::format(">{}</text>\n", escaped(what));
}

double SvgCanvas::textWidth(std::string_view what, const TextStyle& style) const
{
    return metrics.textWidth(what, style);
}

void SvgCanvas::beginGroup(std::string_view name, const std::optional<Rectangle>& clip)
{
    if (clip)
    {
        ++clips;
        fmt::format_to(std::back_inserter(content),
                       "<clipPath id=\"clip{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n"
                       "<g clip-path=\"url(#clip{})\">",
                       clips, number(clip->left), number(clip->top), number(clip->width()), number(clip->height()),
                       clips);
    }
    else
        content += "<g>";
    if (!name.empty())
        content += fmt::format("<title>{}</title>", escaped(name));
    content += "\n";
}

void SvgCanvas::endGroup()
{
    content += "</g>\n";
}

Result<std::string> SvgCanvas::finish()
{
    content += "</svg>\n";
    return std::move(content);
}

} // namespace pacini::plot
