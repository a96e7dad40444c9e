// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/ResponsePlot.h"

#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pacini::editor
{

namespace
{
constexpr int scaleWidth = 6 * grid;
constexpr int rulerHeight = 2 * grid + 4;
constexpr int legendHeight = 3 * grid;
constexpr double widestSpan = 80.0; // dB

juce::String hertz(double f)
{
    if (f >= 1000.0)
        return numberText(f / 1000.0, std::fmod(f, 1000.0) == 0.0 ? 0 : 1) + " k";
    return juce::String(static_cast<int>(std::lround(f)));
}
} // namespace

ResponsePlot::ResponsePlot(const juce::String& name, const juce::String& help)
{
    setTitle(name);
    setDescription(help);
    setHelpText(help);
}

void ResponsePlot::show(Content wanted)
{
    content = std::move(wanted);
    rescale();
    repaint();
}

double ResponsePlot::scaled(double value) const noexcept
{
    return content.unit == Unit::decibels ? value : Decibels::fromGain(std::max(value, 1e-6)).value;
}

void ResponsePlot::rescale()
{
    low = std::numeric_limits<double>::max();
    high = 0.0;
    double least = std::numeric_limits<double>::max();
    double most = std::numeric_limits<double>::lowest();
    for (const Curve& curve : content.curves)
    {
        if (curve.response.size() < 2)
            continue;
        low = std::min(low, curve.response.frequency.front());
        high = std::max(high, curve.response.frequency.back());
        if (curve.role == Role::noise)
            continue;
        for (const double level : curve.response.level)
        {
            least = std::min(least, scaled(level));
            most = std::max(most, scaled(level));
        }
    }
    if (!(high > low) || !(most >= least))
    {
        low = 10.0;
        high = 1000.0;
        least = -40.0;
        most = 20.0;
    }
    const double coarse = content.unit == Unit::percent ? 20.0 : 10.0;
    top = coarse * std::ceil((most + 1.0) / coarse);
    bottom = std::max(coarse * std::floor((least - 1.0) / coarse), top - widestSpan);
    constexpr double leastPercent = -40.0; // 0.01 %
    if (content.unit == Unit::percent)
    {
        top = std::max(top, leastPercent + 2.0 * coarse);
        bottom = std::max(std::min(bottom, top - 2.0 * coarse), leastPercent);
    }
    // As many lines as keep their numbers apart.
    step = coarse;
    while (plotArea().getHeight() * step / (top - bottom) < 2.5 * grid && step < top - bottom)
        step *= 2.0;
}

juce::Rectangle<int> ResponsePlot::plotArea() const
{
    return getLocalBounds()
        .withTrimmedLeft(scaleWidth)
        .withTrimmedTop(legendHeight)
        .withTrimmedBottom(rulerHeight)
        .withTrimmedRight(grid);
}

float ResponsePlot::xOf(double frequency) const
{
    const auto area = plotArea();
    return static_cast<float>(area.getX() + area.getWidth() * std::log(frequency / low) / std::log(high / low));
}

float ResponsePlot::yOf(double value) const
{
    const auto area = plotArea();
    return static_cast<float>(area.getY() + area.getHeight() * (top - value) / (top - bottom));
}

juce::Point<float> ResponsePlot::placeOf(double frequency, double value) const
{
    return {xOf(frequency), yOf(scaled(value))};
}

juce::Colour ResponsePlot::colourOf(Role role) const
{
    const Palette& p = paletteFor(*this);
    switch (role)
    {
    case Role::single:
    case Role::noise:
        return p.dim;
    case Role::leftOut:
        return p.warning;
    case Role::before:
        return p.text;
    case Role::result:
        break;
    }
    return p.accent;
}

void ResponsePlot::paintGrid(juce::Graphics& g) const
{
    const Palette& p = paletteFor(*this);
    const auto area = plotArea();
    g.setFont(smallFont());
    for (double value = step * std::ceil(bottom / step); value <= top + 1e-9; value += step)
    {
        const float y = yOf(value);
        g.setColour(p.line.withAlpha(0.6f));
        g.fillRect(static_cast<float>(area.getX()), y, static_cast<float>(area.getWidth()), 1.0f);
        g.setColour(p.dim);
        const juce::String text =
            content.unit == Unit::decibels
                ? juce::String(static_cast<int>(std::lround(value)))
                : numberText(Decibels(value).gain(), value < -1.0 ? (value < -21.0 ? 2 : 1) : 0) + " %";
        g.drawText(text, juce::Rectangle<float>(0.0f, y - grid, scaleWidth - 6.0f, 2.0f * grid),
                   juce::Justification::centredRight, false);
    }
    float free = 0.0f; // x up to which numbers stand
    for (double decade = 1.0; decade < high; decade *= 10.0)
        for (int i = 1; i < 10; ++i)
        {
            const double f = decade * i;
            if (f < low * 0.999 || f > high * 1.001)
                continue;
            const float x = xOf(f);
            g.setColour(p.line.withAlpha(i == 1 ? 0.9f : 0.35f));
            g.fillRect(x, static_cast<float>(area.getY()), 1.0f, static_cast<float>(area.getHeight()));
            if (i != 1 && i != 2 && i != 5)
                continue;
            const auto place = juce::Rectangle<float>(x - 2.5f * grid, static_cast<float>(area.getBottom() + 2),
                                                      5.0f * grid, 2.0f * grid);
            if (place.getX() + grid < free || place.getRight() > static_cast<float>(getWidth()) + grid)
                continue;
            free = place.getRight() - grid;
            g.setColour(p.dim);
            const char* const unit = i != 1 ? "" : f < 1000.0 ? " Hz" : "Hz"; // 20 Hz, 2 kHz
            g.drawText(hertz(f) + unit, place, juce::Justification::centred, false);
        }
}

void ResponsePlot::paintCurve(juce::Graphics& g, const Curve& curve) const
{
    const FrequencyResponse& response = curve.response;
    if (response.size() < 2)
        return;
    juce::Path path;
    path.preallocateSpace(static_cast<int>(3 * response.size() + 8));
    for (std::size_t i = 0; i < response.size(); ++i)
    {
        // Far outside of the picture lines get slow.
        const auto y = yOf(std::clamp(scaled(response.level[i]), bottom - widestSpan, top + widestSpan));
        if (i == 0)
            path.startNewSubPath(xOf(response.frequency[i]), y);
        else
            path.lineTo(xOf(response.frequency[i]), y);
    }
    const bool strong = curve.role == Role::result || curve.role == Role::before;
    g.setColour(colourOf(curve.role).withAlpha(curve.role == Role::single ? 0.7f : 1.0f));
    const juce::PathStrokeType stroke(strong ? 2.0f : 1.0f, juce::PathStrokeType::curved);
    if (curve.role == Role::noise || curve.role == Role::leftOut)
    {
        const std::array<float, 2> dashes = curve.role == Role::noise ? std::array{2.0f, 3.0f} : std::array{6.0f, 4.0f};
        juce::Path dashed;
        stroke.createDashedStroke(dashed, path, dashes.data(), 2);
        g.fillPath(dashed);
    }
    else
        g.strokePath(path, stroke);
}

void ResponsePlot::paintLegend(juce::Graphics& g) const
{
    const Palette& p = paletteFor(*this);
    g.setFont(smallFont());
    int x = plotArea().getX();
    g.setColour(p.dim);
    juce::StringArray said;
    int right = getWidth() - grid;
    if (content.axisName.isNotEmpty())
    {
        const int width = smallFont().getStringWidth(content.axisName) + 4;
        g.drawText(content.axisName, right - width, 0, width, legendHeight - 4, juce::Justification::centredRight,
                   false);
        right -= width + grid;
    }
    for (const Curve& curve : content.curves)
    {
        if (said.contains(curve.name))
            continue;
        said.add(curve.name);
        const int width = smallFont().getStringWidth(curve.name) + 4;
        if (x + width + 3 * grid > right)
            break;
        g.setColour(colourOf(curve.role));
        const auto y = static_cast<float>(legendHeight - 4) / 2.0f;
        if (curve.role == Role::noise || curve.role == Role::leftOut)
            for (int dot = 0; dot < 3; ++dot)
                g.fillRect(static_cast<float>(x + 6 * dot), y - 1.0f, 3.0f, 2.0f);
        else
            g.fillRect(static_cast<float>(x), y - 1.0f, 16.0f, curve.role == Role::single ? 1.0f : 2.0f);
        g.setColour(p.text);
        g.drawText(curve.name, x + 2 * grid + 4, 0, width, legendHeight - 4, juce::Justification::centredLeft, false);
        x += width + 5 * grid;
    }
}

juce::String ResponsePlot::valueText(double value) const
{
    return content.unit == Unit::decibels ? numberText(value, 1) + " dB" : numberText(value, 2) + " %";
}

void ResponsePlot::paintReading(juce::Graphics& g) const
{
    if (!pointed || content.curves.empty())
        return;
    const Palette& p = paletteFor(*this);
    const auto area = plotArea();
    const FrequencyResponse& response = content.curves.back().response;
    if (response.size() < 2)
        return;
    const double value = levelAt(response, *pointed);
    const float x = xOf(*pointed);
    g.setColour(p.dim);
    g.fillRect(x, static_cast<float>(area.getY()), 1.0f, static_cast<float>(area.getHeight()));
    const juce::String text = numberText(*pointed, *pointed < 100.0 ? 1 : 0) + " Hz  " + valueText(value);
    g.setFont(smallFont());
    const int width = smallFont().getStringWidth(text) + 2 * grid;
    auto box = juce::Rectangle<int>(static_cast<int>(x) + grid, area.getY() + grid / 2, width, 3 * grid - 4);
    if (box.getRight() > area.getRight())
        box.setX(static_cast<int>(x) - grid - width);
    g.setColour(p.card);
    g.fillRoundedRectangle(box.toFloat(), 3.0f);
    g.setColour(p.line);
    g.drawRoundedRectangle(box.toFloat().reduced(0.5f), 3.0f, 1.0f);
    g.setColour(p.text);
    g.drawText(text, box, juce::Justification::centred, false);
    g.setColour(colourOf(content.curves.back().role));
    g.fillEllipse(juce::Rectangle<float>(7.0f, 7.0f).withCentre({x, yOf(std::clamp(scaled(value), bottom, top))}));
}

void ResponsePlot::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    const auto area = plotArea();
    g.setColour(p.well);
    g.fillRect(area);
    if (content.curves.empty())
    {
        g.setColour(p.dim);
        g.setFont(usualFont());
        g.drawFittedText(content.empty, area.reduced(2 * grid), juce::Justification::centred, 4);
        return;
    }
    paintGrid(g);
    {
        const juce::Graphics::ScopedSaveState saved(g);
        g.reduceClipRegion(area);
        float from = static_cast<float>(area.getX()), to = static_cast<float>(area.getRight());
        if (content.range)
        {
            from = xOf(content.range->first);
            to = xOf(content.range->second);
            g.setColour(p.background.withAlpha(0.6f));
            g.fillRect(area.toFloat().withRight(from));
            g.fillRect(area.toFloat().withLeft(to));
            g.setColour(p.line);
            g.fillRect(from, static_cast<float>(area.getY()), 1.0f, static_cast<float>(area.getHeight()));
            g.fillRect(to, static_cast<float>(area.getY()), 1.0f, static_cast<float>(area.getHeight()));
        }
        if (content.band)
        {
            const float upper = yOf(content.band->second), lower = yOf(content.band->first);
            g.setColour(p.accent.withAlpha(0.14f));
            g.fillRect(juce::Rectangle<float>::leftTopRightBottom(from, upper, to, lower));
            g.setColour(p.accent.withAlpha(0.5f));
            g.fillRect(from, upper, to - from, 1.0f);
            g.fillRect(from, lower, to - from, 1.0f);
        }
        if (content.marker)
        {
            g.setColour(p.dim);
            const float x = xOf(*content.marker);
            const std::array<float, 2> dashes{4.0f, 4.0f};
            g.drawDashedLine({x, static_cast<float>(area.getY()), x, static_cast<float>(area.getBottom())},
                             dashes.data(), 2, 1.0f);
        }
        for (const Curve& curve : content.curves)
            paintCurve(g, curve);
        paintReading(g);
    }
    paintLegend(g);
}

void ResponsePlot::mouseMove(const juce::MouseEvent& event)
{
    const auto area = plotArea();
    const double share =
        (event.position.x - static_cast<float>(area.getX())) / static_cast<float>(std::max(1, area.getWidth()));
    pointed = share >= 0.0 && share <= 1.0 ? std::optional(low * std::pow(high / low, share)) : std::nullopt;
    repaint();
}

void ResponsePlot::mouseExit(const juce::MouseEvent&)
{
    pointed.reset();
    repaint();
}

} // namespace pacini::editor
