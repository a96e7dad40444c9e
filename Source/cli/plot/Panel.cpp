#include "cli/plot/Panel.h"

#include "cli/plot/SeriesDrawing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace pacini::plot
{

namespace
{
TextStyle labelStyle(const Look& look)
{
    return {look.theme.quietText, look.metrics.text};
}

int maxTicksX(const PlotArea& area, const Look& look)
{
    return static_cast<int>(area.box.width() / (6.0 * look.metrics.text));
}

/// Up to five where they just fit, more only with plenty of room.
int maxTicksY(double height, const Look& look)
{
    const double lines = height / look.metrics.text;
    return std::max(2, static_cast<int>(std::min(lines / 1.15, std::max(5.0, lines / 4.0))));
}

/// The series that the legend names, each name once, if anything of them is seen in a plot of this width.
std::vector<const Series*> legendEntries(const Panel& panel, double plotWidth)
{
    std::vector<const Series*> entries;
    for (const Series& series : panel.series)
        if (isListed(series) && isSeen(series, plotWidth) &&
            std::none_of(entries.begin(), entries.end(),
                         [&](const Series* other) { return nameOf(*other) == nameOf(series); }))
            entries.push_back(&series);
    return entries;
}

double widest(const Canvas& canvas, const std::vector<Tick>& ticks, const TextStyle& style)
{
    double width = 0.0;
    for (const Tick& tick : ticks)
        width = std::max(width, canvas.textWidth(tick.label, style));
    return width;
}

double sampleWidth(const Look& look)
{
    return 1.8 * look.metrics.text;
}

double entryWidth(const Canvas& canvas, const Series& series, const Look& look)
{
    return sampleWidth(look) + look.metrics.gap() + canvas.textWidth(nameOf(series), labelStyle(look));
}

constexpr double everything = std::numeric_limits<double>::infinity();

double legendColumnWidth(const Canvas& canvas, const Panel& panel, const Look& look)
{
    double width = 0.0;
    for (const Series* entry : legendEntries(panel, everything))
        width = std::max(width, entryWidth(canvas, *entry, look));
    return width;
}

/// All samples of the name of `entry`, so that a line and its markers share one line of the legend.
void drawEntry(Canvas& canvas, const Panel& panel, const Series& entry, Point baseline, const Look& look)
{
    const double rise = 0.36 * look.metrics.text;
    for (const Series& series : panel.series)
        if (isListed(series) && nameOf(series) == nameOf(entry))
            drawSample(canvas, series, {baseline.x + 0.5 * sampleWidth(look), baseline.y - rise}, sampleWidth(look));
    canvas.text({baseline.x + sampleWidth(look) + look.metrics.gap(), baseline.y}, nameOf(entry), labelStyle(look));
}

/// Returns the pixels that the title may take.
double drawLegendAbove(Canvas& canvas, const Panel& panel, const Rectangle& plot, const Look& look)
{
    double x = plot.right;
    auto entries = legendEntries(panel, plot.width());
    std::reverse(entries.begin(), entries.end());
    for (const Series* entry : entries)
    {
        x -= entryWidth(canvas, *entry, look);
        if (x < plot.left)
            break;
        drawEntry(canvas, panel, *entry, {x, plot.top - look.metrics.gap()}, look);
        x -= 1.2 * look.metrics.text;
    }
    return x - plot.left;
}

void drawLegendRight(Canvas& canvas, const Panel& panel, const Rectangle& plot, const Look& look)
{
    double y = plot.top + look.metrics.text;
    for (const Series* entry : legendEntries(panel, plot.width()))
    {
        drawEntry(canvas, panel, *entry, {plot.right + 1.5 * look.metrics.text, y}, look);
        y += look.metrics.line();
    }
}

void drawGrid(Canvas& canvas, const Panel& panel, const PlotArea& area, const std::vector<Tick>& ticksX,
              const std::vector<Tick>& ticksY, const Look& look)
{
    const Rectangle& box = area.box;
    const double hair = look.metrics.hair();
    Path major;
    Path minor;
    for (const Tick& tick : ticksX)
        (tick.label.empty() ? minor : major)
            .segment({area.atX(tick.value), box.top}, {area.atX(tick.value), box.bottom});
    if (panel.crossGrid)
        for (const Tick& tick : ticksY)
            if (area.showsY(tick.value))
                (tick.label.empty() ? minor : major)
                    .segment({box.left, area.atY(tick.value)}, {box.right, area.atY(tick.value)});
    canvas.draw(minor, {{}, Stroke{mix(look.theme.ground, look.theme.grid, 0.5), hair, 0.0, false}});
    canvas.draw(major, {{}, Stroke{look.theme.grid, hair, 0.0, false}});
}

void drawRules(Canvas& canvas, const Panel& panel, const PlotArea& area, const Look& look)
{
    Path path;
    for (const Rule& rule : panel.rules)
        if (area.showsX(rule.x))
            path.segment({area.atX(rule.x), area.box.top}, {area.atX(rule.x), area.box.bottom});
    canvas.draw(path, {{}, Stroke{look.theme.quietText, look.metrics.hair(), 3.0 * look.metrics.hair(), false}});
}

/// On a ground of their own, over the series.
void labelRules(Canvas& canvas, const Panel& panel, const PlotArea& area, const Look& look,
                std::vector<Rectangle>& taken)
{
    const TextStyle style{look.theme.text, 0.85 * look.metrics.text};
    double free = area.box.left;
    for (const Rule& rule : panel.rules)
    {
        if (!area.showsX(rule.x) || rule.label.empty())
            continue;
        const std::string label = shortened(canvas, rule.label, style, 0.25 * area.box.width());
        const double left = area.atX(rule.x) + look.metrics.hair();
        const Rectangle box{left, area.box.top + look.metrics.hair(),
                            left + canvas.textWidth(label, style) + 0.6 * style.size, area.box.top + 1.4 * style.size};
        if (left < free || box.right > area.box.right)
            continue;
        Path ground;
        ground.rectangle(box);
        canvas.draw(ground, {look.theme.ground.withAlpha(0.8), {}});
        canvas.text({left + 0.3 * style.size, area.box.top + 1.1 * style.size}, label, style);
        taken.push_back(box);
        free = box.right;
    }
}

/// After all series, so that no text is drawn over and none covers a marker.
void labelSeries(Canvas& canvas, const Panel& panel, const PlotArea& area, const Look& look,
                 std::vector<Rectangle>& taken)
{
    const auto labelled = [](const Series& series)
    {
        const auto* line = std::get_if<Line>(&series);
        return line != nullptr && !line->labels.empty();
    };
    if (std::none_of(panel.series.begin(), panel.series.end(), labelled))
        return;
    for (const Series& series : panel.series)
        markTaken(series, area, taken);
    for (const Series& series : panel.series)
        if (labelled(series))
            labelPoints(canvas, std::get<Line>(series), area, look, taken);
}

void drawAxisX(Canvas& canvas, const Panel& panel, const PlotArea& area, const std::vector<Tick>& ticks,
               const Look& look)
{
    TextStyle style = labelStyle(look);
    style.align = Align::centre;
    const double y = area.box.bottom + look.metrics.gap() + 0.8 * look.metrics.text;
    double free = area.box.left - look.metrics.line() * 2.0;
    for (const Tick& tick : ticks)
    {
        const double x = area.atX(tick.value);
        const double half = 0.5 * canvas.textWidth(tick.label, style);
        if (tick.label.empty() || x - half < free)
            continue;
        canvas.text({x, y}, tick.label, style);
        free = x + half + look.metrics.gap();
    }
    style.colour = look.theme.text;
    canvas.text({0.5 * (area.box.left + area.box.right), y + look.metrics.line()}, panel.x.title, style);
}

/// Draws labels right-aligned at the left of the plot, or left-aligned at its right; none overlaps the one before.
void drawLabelsY(Canvas& canvas, const std::vector<Tick>& ticks, const PlotArea& area, Align align, const Look& look)
{
    TextStyle style = labelStyle(look);
    style.align = align;
    const double x = align == Align::right ? area.box.left - look.metrics.gap() : area.box.right + look.metrics.gap();
    double free = area.box.bottom + look.metrics.line();
    for (const Tick& tick : ticks)
    {
        const double y = area.atY(tick.value);
        if (tick.label.empty() || !area.showsY(tick.value) || y + 0.5 * look.metrics.text > free)
            continue;
        canvas.text({x, y + 0.36 * look.metrics.text}, tick.label, style);
        free = y - 0.5 * look.metrics.text;
    }
}
} // namespace

Margins marginsOf(const Canvas& canvas, const Panel& panel, double height, bool withX, const Look& look)
{
    const Metrics& m = look.metrics;
    const TextStyle style = labelStyle(look);
    Margins margins;
    margins.left = m.gap() + widest(canvas, ticksOf(panel.y, maxTicksY(height, look)), style);
    if (!panel.y.title.empty())
        margins.left += m.gap() + m.line();
    margins.right = panel.rightLabels.empty() ? 0.0 : m.gap() + widest(canvas, panel.rightLabels, style);
    if (panel.legend == LegendPlace::right)
        margins.right += 1.5 * m.text + legendColumnWidth(canvas, panel, look);
    const bool lineAbove =
        !panel.title.empty() || (panel.legend == LegendPlace::above && !legendEntries(panel, everything).empty());
    margins.top = lineAbove ? m.line() + m.gap() : m.gap();
    // The last label of the x axis is centred at its end.
    if (withX)
        margins.right = std::max(margins.right, 0.5 * widest(canvas, ticksOf(panel.x, 10), style));
    margins.bottom = withX ? m.gap() + 2.2 * m.line() : 0.0;
    return margins;
}

void drawPanel(Canvas& canvas, const Panel& panel, const Rectangle& plot, const Margins& margins, bool withX,
               const Look& look)
{
    const PlotArea area{plot, panel.x, panel.y};
    const auto ticksX = ticksOf(panel.x, maxTicksX(area, look));
    const auto ticksY = ticksOf(panel.y, maxTicksY(plot.height(), look));
    std::vector<Rectangle> taken;

    canvas.beginGroup(panel.title);
    drawGrid(canvas, panel, area, ticksX, ticksY, look);
    drawRules(canvas, panel, area, look);
    Path frame;
    frame.rectangle(plot);
    canvas.draw(frame, {{}, Stroke{look.theme.frame, look.metrics.hair(), 0.0, false}});
    for (const Series& series : panel.series)
        drawSeries(canvas, series, area, look);
    labelRules(canvas, panel, area, look, taken);
    labelSeries(canvas, panel, area, look, taken);

    drawLabelsY(canvas, ticksY, area, Align::right, look);
    drawLabelsY(canvas, panel.rightLabels, area, Align::left, look);
    TextStyle titleStyle{look.theme.text, look.metrics.text, false, Align::centre, true};
    const double titleRoom = plot.height() + look.metrics.line();
    if (titleRoom > 4.0 * look.metrics.text)
        canvas.text({plot.left - margins.left + 0.8 * look.metrics.text, 0.5 * (plot.top + plot.bottom)},
                    shortened(canvas, panel.y.title, titleStyle, titleRoom), titleStyle);
    if (withX)
        drawAxisX(canvas, panel, area, ticksX, look);
    double room = plot.width();
    if (panel.legend == LegendPlace::above)
        room = drawLegendAbove(canvas, panel, plot, look);
    else if (panel.legend == LegendPlace::right)
        drawLegendRight(canvas, panel, plot, look);
    titleStyle.bold = true;
    titleStyle.upwards = false;
    titleStyle.align = Align::left;
    if (room > 0.0)
        canvas.text({plot.left, plot.top - look.metrics.gap()}, shortened(canvas, panel.title, titleStyle, room),
                    titleStyle);
    canvas.endGroup();
}

} // namespace pacini::plot
