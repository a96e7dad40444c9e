// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Drawn signs of buttons: one stroke, one size, whatever fonts there are.

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

enum class Icon
{
    toStart,
    play,
    pause,
    stop,
    loop,
    zoomIn,
    zoomOut,
    fit,
    add,
    remove,
    undo,
    redo,
    menu,
    draw,
    snap,
    tick
};

/// Draws the icon in the colour of `g`, 16 points wide at most, in the middle of `area`.
void drawIcon(juce::Graphics& g, Icon icon, juce::Rectangle<float> area);

/// A button with an icon and, where it has a text, that text behind it.
class IconButton final : public juce::Button
{
public:
    /// `title` is what screen readers say.
    explicit IconButton(Icon wanted, const juce::String& title = {});

    void setIcon(Icon wanted);
    [[nodiscard]] Icon icon() const noexcept { return shown; }

    void paintButton(juce::Graphics& g, bool highlighted, bool down) override;

private:
    Icon shown;
};

} // namespace pacini::editor
