// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Filling of columns of one pixel beside each other, without seams at any scale of the interface.

#include <juce_gui_basics/juce_gui_basics.h>

#include <cmath>

namespace pacini::editor
{

/// Columns of one colour. At whole scales they are rectangles, which are many times faster than paths; at others their
/// edges lie inside of pixels, where two rectangles beside each other leave a stripe, so that they become one path.
class ColumnFill
{
public:
    ColumnFill(juce::Graphics& graphics, juce::Colour wanted) : g(graphics), colour(wanted)
    {
        const double scale = static_cast<double>(g.getInternalContext().getPhysicalPixelScaleFactor());
        whole = std::abs(scale - std::round(scale)) < 1e-3;
    }

    ~ColumnFill()
    {
        if (path.isEmpty())
            return;
        g.setColour(colour);
        g.fillPath(path);
    }

    ColumnFill(const ColumnFill&) = delete;
    ColumnFill& operator=(const ColumnFill&) = delete;

    void add(int x, int y, int height)
    {
        if (height <= 0)
            return;
        if (!whole)
            return path.addRectangle(juce::Rectangle<int>(x, y, 1, height));
        g.setColour(colour);
        g.fillRect(x, y, 1, height);
    }

private:
    juce::Graphics& g;
    const juce::Colour colour;
    bool whole = true;
    juce::Path path;
};

} // namespace pacini::editor
