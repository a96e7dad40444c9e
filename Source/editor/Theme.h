// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Look of all windows, light or dark, made from the design tokens.

#include "editor/Fonts.h"
#include "editor/Tokens.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <optional>

namespace pacini::editor
{

[[nodiscard]] const Palette& paletteOf(bool dark) noexcept;

/// Whether the system's theme is the dark one; dark where it does not say. [message]
[[nodiscard]] bool systemIsDark();

/// Marks the one prominent button of a bar, or takes the mark away.
void makePrimary(juce::Button& button, bool isPrimary = true);

/// The colour of a button's text or icon, by what it is and whether it is on.
[[nodiscard]] juce::Colour buttonTextColour(const juce::Button& button);

/// The value that the arc of a slider starts at. Without it that is 0 of a slider that goes both ways, else its lowest.
void setOrigin(juce::Slider& slider, double value);

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
    void drawButtonText(juce::Graphics&, juce::TextButton&, bool highlighted, bool down) override;
    void drawMenuBarItem(juce::Graphics&, int width, int height, int index, const juce::String& text, bool over,
                         bool open, bool overBar, juce::MenuBarComponent&) override;
    void drawScrollbar(juce::Graphics&, juce::ScrollBar&, int x, int y, int width, int height, bool vertical,
                       int thumbStart, int thumbSize, bool over, bool down) override;
    int getDefaultScrollbarWidth() override { return space::scrollBar; }
    void drawTickBox(juce::Graphics&, juce::Component&, float x, float y, float w, float h, bool ticked, bool enabled,
                     bool highlighted, bool down) override;
    juce::Slider::SliderLayout getSliderLayout(juce::Slider&) override;
    void drawComboBox(juce::Graphics&, int width, int height, bool down, int x, int y, int w, int h,
                      juce::ComboBox&) override;
    void positionComboBoxText(juce::ComboBox&, juce::Label&) override;
    void drawComboBoxTextWhenNothingSelected(juce::Graphics&, juce::ComboBox&, juce::Label&) override;
    void drawPopupMenuItem(juce::Graphics&, const juce::Rectangle<int>& area, bool isSeparator, bool isActive,
                           bool isHighlighted, bool isTicked, bool hasSubMenu, const juce::String& text,
                           const juce::String& shortcut, const juce::Drawable* icon,
                           const juce::Colour* colour) override;
    juce::Font getComboBoxFont(juce::ComboBox&) override;
    juce::Font getPopupMenuFont() override;
    void getIdealPopupMenuItemSize(const juce::String& text, bool isSeparator, int standardHeight, int& width,
                                   int& height) override;
    void drawProgressBar(juce::Graphics&, juce::ProgressBar&, int width, int height, double progress,
                         const juce::String& text) override;
    bool isProgressBarOpaque(juce::ProgressBar&) override { return false; }
    juce::Font getMenuBarFont(juce::MenuBarComponent&, int, const juce::String&) override;
    juce::Font getTextButtonFont(juce::TextButton&, int height) override;
    juce::Font getLabelFont(juce::Label&) override;
    juce::Label* createSliderTextBox(juce::Slider&) override;
    void fillTextEditorBackground(juce::Graphics&, int width, int height, juce::TextEditor&) override;
    void drawTextEditorOutline(juce::Graphics&, int width, int height, juce::TextEditor&) override;
    juce::Rectangle<int> getTooltipBounds(const juce::String& text, juce::Point<int> pointer,
                                          juce::Rectangle<int> within) override;
    void drawTooltip(juce::Graphics&, const juce::String& text, int width, int height) override;
    juce::Typeface::Ptr getTypefaceForFont(const juce::Font&) override;
    void layoutFileBrowserComponent(juce::FileBrowserComponent&, juce::DirectoryContentsDisplayComponent*,
                                    juce::FilePreviewComponent*, juce::ComboBox* path, juce::TextEditor* name,
                                    juce::Button* up) override;
    void drawLabel(juce::Graphics&, juce::Label&) override;
    void drawMenuBarBackground(juce::Graphics&, int width, int height, bool, juce::MenuBarComponent&) override;
    int getTabButtonBestWidth(juce::TabBarButton&, int depth) override;
    void drawTabButton(juce::TabBarButton&, juce::Graphics&, bool over, bool down) override;
    void drawTabAreaBehindFrontButton(juce::TabbedButtonBar&, juce::Graphics&, int width, int height) override;

private:
    bool darkNow = true;
};

/// While it lives, a look is that of windows which nobody gives one: JUCE's own for files, where the system has none.
class DefaultLook
{
public:
    explicit DefaultLook(juce::LookAndFeel& look) { juce::LookAndFeel::setDefaultLookAndFeel(&look); }
    ~DefaultLook() { juce::LookAndFeel::setDefaultLookAndFeel(&before); }
    DefaultLook(const DefaultLook&) = delete;
    DefaultLook& operator=(const DefaultLook&) = delete;

private:
    juce::LookAndFeel& before = juce::LookAndFeel::getDefaultLookAndFeel();
};

/// The look of a component's window; a dark one for a component without.
[[nodiscard]] const Palette& paletteFor(const juce::Component& component);

/// Of secondary text in a row of a list; on the ground of a selected one it would be too faint.
[[nodiscard]] inline juce::Colour quietTextColour(const Palette& palette, bool isSelected) noexcept
{
    return isSelected ? palette.text : palette.dim;
}

/// A rounded panel behind a group of controls, with its name in the first row; what is left inside.
juce::Rectangle<int> drawCard(juce::Graphics& g, juce::Rectangle<int> area, const juce::String& name,
                              const Palette& palette);
/// The same rectangle without drawing.
[[nodiscard]] juce::Rectangle<int> insideOfCard(juce::Rectangle<int> area) noexcept;

/// A ring around the component that the keyboard speaks to, in the accent or another colour that is seen there.
void drawFocusRing(juce::Graphics& g, const juce::Component& component, juce::Rectangle<float> around,
                   std::optional<juce::Colour> colour = std::nullopt);

} // namespace pacini::editor
