#include "cli/plot/Figure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pacini::plot
{

Look lookFor(const FigureStyle& style)
{
    const double scale = std::min(style.size.width / 1600.0, style.size.height / 1000.0);
    return {style.dark ? darkTheme() : lightTheme(), Metrics(15.0 * (scale < 1.0 ? std::sqrt(scale) : scale))};
}

void drawFigure(Canvas& canvas, const Figure& figure, const FigureStyle& style)
{
    const Look look = lookFor(style);
    const Metrics& m = look.metrics;
    const Rectangle page{0.0, 0.0, static_cast<double>(style.size.width), static_cast<double>(style.size.height)};
    Path ground;
    ground.rectangle(page);
    canvas.draw(ground, {look.theme.ground, {}});

    const double border = 1.2 * m.text;
    double top = page.top + border;
    if (!figure.title.empty())
    {
        const TextStyle title{look.theme.text, m.title(), true};
        top += m.title();
        canvas.text({border, top}, shortened(canvas, figure.title, title, page.width() - 2.0 * border), title);
    }
    if (!figure.subtitle.empty())
    {
        const TextStyle subtitle{look.theme.quietText, m.text};
        top += m.line();
        canvas.text({border, top}, shortened(canvas, figure.subtitle, subtitle, page.width() - 2.0 * border), subtitle);
    }
    top += m.gap();
    if (figure.panels.empty())
        return;

    double left = page.bottom - border - top;
    double shares = 0.0;
    const auto showsX = [&](std::size_t i)
    {
        return i + 1 == figure.panels.size() || figure.panels[i + 1].x.title != figure.panels[i].x.title;
    };
    for (std::size_t i = 0; i < figure.panels.size(); ++i)
    {
        // Above and below a plot the margins do not depend on its height.
        const Margins any = marginsOf(canvas, figure.panels[i], 0.0, showsX(i), look);
        left -= any.top + any.bottom;
        shares += figure.panels[i].share;
    }
    left = std::max(left, static_cast<double>(figure.panels.size()));
    // Margins at the sides are those of the widest panel, so that the time axes stand above each other.
    Margins sides;
    std::vector<Margins> margins;
    for (std::size_t i = 0; i < figure.panels.size(); ++i)
    {
        const Panel& panel = figure.panels[i];
        margins.push_back(marginsOf(canvas, panel, left * panel.share / shares, showsX(i), look));
        sides.left = std::max(sides.left, margins[i].left);
        sides.right = std::max(sides.right, margins[i].right);
    }
    for (std::size_t i = 0; i < figure.panels.size(); ++i)
    {
        const Panel& panel = figure.panels[i];
        top += margins[i].top;
        const double bottom = top + left * panel.share / shares;
        // On whole pixels frames are sharp.
        const Rectangle plot{std::round(border + sides.left) + 0.5, std::round(top) + 0.5,
                             std::round(page.right - border - sides.right) - 0.5, std::round(bottom) - 0.5};
        margins[i].left = sides.left;
        margins[i].right = sides.right;
        drawPanel(canvas, panel, plot, margins[i], showsX(i), look);
        top = bottom + margins[i].bottom;
    }
}

Result<std::size_t> writeFigure(const std::filesystem::path& path, const Figure& figure, const FigureStyle& style,
                                Replaceable replaceable)
{
    return writePicture(
        path, style.size, figure.title, [&](Canvas& canvas) { drawFigure(canvas, figure, style); }, replaceable);
}

} // namespace pacini::plot
