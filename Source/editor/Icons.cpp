// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/Icons.h"

#include "editor/Theme.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr float iconSide = 16.0f; // of the square that icons are drawn in
constexpr float iconStroke = 1.6f;

/// Lines are stroked, shapes are filled.
struct Sign
{
    juce::Path lines, shapes;
};

void polyline(juce::Path& path, std::initializer_list<juce::Point<float>> points)
{
    bool first = true;
    for (const auto point : points)
    {
        if (first)
            path.startNewSubPath(point);
        else
            path.lineTo(point);
        first = false;
    }
}

void magnifier(Sign& sign, bool plus)
{
    sign.lines.addEllipse(2.0f, 2.0f, 9.0f, 9.0f);
    polyline(sign.lines, {{10.0f, 10.0f}, {14.0f, 14.0f}});
    polyline(sign.lines, {{4.5f, 6.5f}, {8.5f, 6.5f}});
    if (plus)
        polyline(sign.lines, {{6.5f, 4.5f}, {6.5f, 8.5f}});
}

/// An arrow that turns back to the left.
void turn(Sign& sign, bool mirrored)
{
    polyline(sign.lines, {{6.5f, 2.0f}, {2.5f, 6.0f}, {6.5f, 10.0f}});
    polyline(sign.lines, {{2.5f, 6.0f}, {9.5f, 6.0f}});
    sign.lines.addArc(5.5f, 6.0f, 8.0f, 8.0f, 0.0f, juce::MathConstants<float>::pi);
    sign.lines.lineTo(6.0f, 14.0f);
    if (mirrored)
        sign.lines.applyTransform(juce::AffineTransform::scale(-1.0f, 1.0f).translated(iconSide, 0.0f));
}

Sign signOf(Icon icon)
{
    Sign sign;
    switch (icon)
    {
    case Icon::toStart:
        sign.shapes.addRectangle(3.0f, 3.0f, 2.0f, 10.0f);
        sign.shapes.addTriangle(13.0f, 3.0f, 13.0f, 13.0f, 6.0f, 8.0f);
        break;
    case Icon::play:
        sign.shapes.addTriangle(4.0f, 2.5f, 4.0f, 13.5f, 13.5f, 8.0f);
        break;
    case Icon::pause:
        sign.shapes.addRectangle(3.5f, 3.0f, 3.0f, 10.0f);
        sign.shapes.addRectangle(9.5f, 3.0f, 3.0f, 10.0f);
        break;
    case Icon::stop:
        sign.shapes.addRectangle(3.5f, 3.5f, 9.0f, 9.0f);
        break;
    case Icon::loop:
        polyline(sign.lines, {{2.5f, 8.0f}, {2.5f, 7.0f}, {5.0f, 4.5f}, {13.0f, 4.5f}});
        polyline(sign.lines, {{10.5f, 2.0f}, {13.0f, 4.5f}, {10.5f, 7.0f}});
        polyline(sign.lines, {{13.5f, 8.0f}, {13.5f, 9.0f}, {11.0f, 11.5f}, {3.0f, 11.5f}});
        polyline(sign.lines, {{5.5f, 9.0f}, {3.0f, 11.5f}, {5.5f, 14.0f}});
        break;
    case Icon::zoomIn:
    case Icon::zoomOut:
        magnifier(sign, icon == Icon::zoomIn);
        break;
    case Icon::fit:
        polyline(sign.lines, {{1.5f, 3.0f}, {1.5f, 13.0f}});
        polyline(sign.lines, {{14.5f, 3.0f}, {14.5f, 13.0f}});
        polyline(sign.lines, {{4.0f, 8.0f}, {12.0f, 8.0f}});
        polyline(sign.lines, {{6.0f, 5.5f}, {3.8f, 8.0f}, {6.0f, 10.5f}});
        polyline(sign.lines, {{10.0f, 5.5f}, {12.2f, 8.0f}, {10.0f, 10.5f}});
        break;
    case Icon::add:
        polyline(sign.lines, {{8.0f, 3.0f}, {8.0f, 13.0f}});
        polyline(sign.lines, {{3.0f, 8.0f}, {13.0f, 8.0f}});
        break;
    case Icon::remove:
        polyline(sign.lines, {{3.0f, 8.0f}, {13.0f, 8.0f}});
        break;
    case Icon::undo:
    case Icon::redo:
        turn(sign, icon == Icon::redo);
        break;
    case Icon::menu:
        for (const float y : {4.0f, 8.0f, 12.0f})
            polyline(sign.lines, {{2.0f, y}, {14.0f, y}});
        break;
    case Icon::draw:
        polyline(sign.lines,
                 {{3.0f, 13.0f}, {3.6f, 10.0f}, {11.0f, 2.6f}, {13.4f, 5.0f}, {6.0f, 12.4f}, {3.0f, 13.0f}});
        break;
    case Icon::snap: // a magnet
        polyline(sign.lines, {{3.0f, 2.5f}, {3.0f, 8.5f}});
        sign.lines.addCentredArc(8.0f, 8.5f, 5.0f, 5.0f, 0.0f, -0.5f * juce::MathConstants<float>::pi,
                                 -1.5f * juce::MathConstants<float>::pi);
        sign.lines.lineTo(13.0f, 2.5f);
        polyline(sign.lines, {{1.6f, 5.5f}, {4.4f, 5.5f}});
        polyline(sign.lines, {{11.6f, 5.5f}, {14.4f, 5.5f}});
        break;
    case Icon::tick:
        polyline(sign.lines, {{3.0f, 8.5f}, {6.5f, 12.0f}, {13.0f, 4.5f}});
        break;
    }
    return sign;
}
} // namespace

void drawIcon(juce::Graphics& g, Icon icon, juce::Rectangle<float> area)
{
    const float size = std::min({iconSide, area.getWidth(), area.getHeight()});
    const auto box = area.withSizeKeepingCentre(size, size);
    const auto place = juce::AffineTransform::scale(size / iconSide).translated(box.getX(), box.getY());
    const Sign sign = signOf(icon);
    g.fillPath(sign.shapes, place);
    g.strokePath(sign.lines,
                 juce::PathStrokeType(iconStroke, juce::PathStrokeType::curved, juce::PathStrokeType::rounded), place);
}

IconButton::IconButton(Icon wanted, const juce::String& title) : juce::Button({}), shown(wanted)
{
    setTitle(title);
    setWantsKeyboardFocus(true);
}

void IconButton::setIcon(Icon wanted)
{
    if (std::exchange(shown, wanted) != wanted)
        repaint();
}

void IconButton::paintButton(juce::Graphics& g, bool highlighted, bool down)
{
    getLookAndFeel().drawButtonBackground(g, *this, {}, highlighted, down);
    g.setColour(buttonTextColour(*this));
    auto area = getLocalBounds();
    const juce::String label = getButtonText();
    if (label.isEmpty())
        return drawIcon(g, shown, area.toFloat());
    const int room = juce::roundToInt(iconSide) + 6;
    const int width = room + smallFont().getStringWidth(label);
    area = area.withSizeKeepingCentre(std::min(width, getWidth() - 8), getHeight());
    drawIcon(g, shown, area.removeFromLeft(room).withTrimmedRight(6).toFloat());
    g.setFont(smallFont());
    g.drawText(label, area.withTrimmedRight(-2), juce::Justification::centredLeft, true);
}

} // namespace pacini::editor
