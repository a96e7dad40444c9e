// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Visual theme of all windows: one grid, one accent, light or dark.

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

/// All distances are multiples of this many pixels.
inline constexpr int grid = 8;

struct Palette
{
    juce::Colour background, card, well, line, text, dim, accent, warning;
};

[[nodiscard]] const Palette& paletteOf(bool dark) noexcept;

/// The look of all components of a window. Setting a palette does not repaint: send lookAndFeelChanged afterwards.
class Look final : public juce::LookAndFeel_V4
{
public:
    Look();

    void setDark(bool dark);
    [[nodiscard]] bool isDark() const noexcept { return darkNow; }
    [[nodiscard]] const Palette& palette() const noexcept { return paletteOf(darkNow); }

    void drawRotarySlider(juce::Graphics&, int x, int y, int width, int height, float place, float startAngle,
                          float endAngle, juce::Slider&) override;
    void drawLinearSlider(juce::Graphics&, int x, int y, int width, int height, float position, float least, float most,
                          juce::Slider::SliderStyle, juce::Slider&) override;
    void drawToggleButton(juce::Graphics&, juce::ToggleButton&, bool highlighted, bool down) override;
    void drawButtonBackground(juce::Graphics&, juce::Button&, const juce::Colour&, bool highlighted,
                              bool down) override;
    void drawComboBox(juce::Graphics&, int width, int height, bool down, int x, int y, int w, int h,
                      juce::ComboBox&) override;
    void positionComboBoxText(juce::ComboBox&, juce::Label&) override;
    juce::Font getComboBoxFont(juce::ComboBox&) override;
    juce::Font getPopupMenuFont() override;
    juce::Font getMenuBarFont(juce::MenuBarComponent&, int, const juce::String&) override;
    juce::Font getTextButtonFont(juce::TextButton&, int height) override;
    juce::Font getLabelFont(juce::Label&) override;
    juce::Label* createSliderTextBox(juce::Slider&) override;
    void drawLabel(juce::Graphics&, juce::Label&) override;
    void drawMenuBarBackground(juce::Graphics&, int width, int height, bool, juce::MenuBarComponent&) override;
    int getTabButtonBestWidth(juce::TabBarButton&, int depth) override;
    void drawTabButton(juce::TabBarButton&, juce::Graphics&, bool over, bool down) override;
    void drawTabAreaBehindFrontButton(juce::TabbedButtonBar&, juce::Graphics&, int width, int height) override;

private:
    bool darkNow = true;
};

/// The look of a component's window; a dark one for a component without.
[[nodiscard]] const Palette& paletteFor(const juce::Component& component);

/// Whether this system has a font with the characters of Japanese.
[[nodiscard]] bool findJapaneseFont();

/// Fonts from now on have the characters of this language: Japanese needs one of its own. [message]
void useFontOf(const juce::String& language);

/// Type sizes: small for units and notes, usual, and large for titles.
[[nodiscard]] juce::Font smallFont();
[[nodiscard]] juce::Font usualFont();
[[nodiscard]] juce::Font titleFont();

/// A rounded panel behind a group of controls, with its name in the first row; what is left inside.
juce::Rectangle<int> drawCard(juce::Graphics& g, juce::Rectangle<int> area, const juce::String& name,
                              const Palette& palette);
/// The same rectangle without drawing.
[[nodiscard]] juce::Rectangle<int> insideOfCard(juce::Rectangle<int> area) noexcept;

/// Around the component that the keyboard speaks to.
void drawFocusRing(juce::Graphics& g, const juce::Component& component, juce::Rectangle<float> around);

} // namespace pacini::editor
