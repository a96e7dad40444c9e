// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Button with a drawn sign instead of words.

#include "editor/Theme.h"

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::plugin
{

class IconButton final : public juce::Button
{
public:
    enum class Icon
    {
        undo,
        redo,
        menu
    };

    explicit IconButton(Icon wanted) : juce::Button({}), icon(wanted) {}

    void paintButton(juce::Graphics& g, bool highlighted, bool down) override
    {
        getLookAndFeel().drawButtonBackground(g, *this, findColour(juce::TextButton::buttonColourId), highlighted,
                                              down);
        const auto& palette = editor::paletteFor(*this);
        g.setColour(isEnabled() ? palette.text : palette.dim.withAlpha(0.5f));
        const auto area = getLocalBounds().toFloat().withSizeKeepingCentre(16.0f, 16.0f);
        g.strokePath(sign(), juce::PathStrokeType(1.6f, juce::PathStrokeType::curved, juce::PathStrokeType::rounded),
                     juce::AffineTransform::translation(area.getX(), area.getY()));
    }

private:
    /// Within 16 by 16.
    [[nodiscard]] juce::Path sign() const
    {
        juce::Path path;
        if (icon == Icon::menu)
        {
            for (const float y : {4.0f, 8.0f, 12.0f})
            {
                path.startNewSubPath(2.0f, y);
                path.lineTo(14.0f, y);
            }
            return path;
        }
        // An arrow that turns back to the left.
        path.startNewSubPath(6.5f, 2.0f);
        path.lineTo(2.5f, 6.0f);
        path.lineTo(6.5f, 10.0f);
        path.startNewSubPath(2.5f, 6.0f);
        path.lineTo(9.5f, 6.0f);
        path.addArc(5.5f, 6.0f, 8.0f, 8.0f, 0.0f, juce::MathConstants<float>::pi);
        path.lineTo(6.0f, 14.0f);
        if (icon == Icon::redo)
            path.applyTransform(juce::AffineTransform::scale(-1.0f, 1.0f).translated(16.0f, 0.0f));
        return path;
    }

    Icon icon;
};

} // namespace pacini::plugin
