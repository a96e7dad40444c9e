// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/Theme.h"

#include "editor/Translation.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{
const juce::Identifier quietProperty("quiet");
constexpr float largestKnob = 32.0f; // radius

/// A font of Japanese that JUCE finds by name, or, on Linux, one in a collection, which it does not list.
struct JapaneseFont
{
    juce::String name;
    juce::Typeface::Ptr plain, bold;
    [[nodiscard]] bool isThere() const { return name.isNotEmpty() || plain != nullptr; }
};

juce::Typeface::Ptr collection(const juce::String& file)
{
    juce::MemoryBlock bytes;
    if (!juce::File(file).loadFileAsData(bytes))
        return nullptr;
    return juce::Typeface::createSystemTypefaceFor(bytes.getData(), bytes.getSize());
}

const JapaneseFont& japaneseFont()
{
    static const JapaneseFont found = []
    {
        JapaneseFont font;
        const auto names = juce::Font::findAllTypefaceNames();
        for (const char* name :
             {"Noto Sans CJK JP", "Noto Sans JP", "Source Han Sans JP", "Hiragino Sans", "Yu Gothic UI", "Meiryo",
              "IPAexGothic", "IPAPGothic", "IPAGothic", "TakaoPGothic", "VL PGothic"})
            if (names.contains(name))
            {
                font.name = name;
                return font;
            }
#if JUCE_LINUX || JUCE_BSD
        const juce::String folder = "/usr/share/fonts/opentype/noto/NotoSansCJK-";
        font.plain = collection(folder + "Regular.ttc");
        if (font.plain != nullptr)
            font.bold = collection(folder + "Bold.ttc");
#endif
        return font;
    }();
    return found;
}

bool japaneseNow = false;

juce::Font fontOf(float height, bool bold)
{
    if (japaneseNow && japaneseFont().plain != nullptr)
    {
        const auto& font = japaneseFont();
        return juce::Font(bold && font.bold != nullptr ? font.bold : font.plain).withHeight(height);
    }
    const int style = bold ? juce::Font::bold : juce::Font::plain;
#if JUCE_MAJOR_VERSION >= 8
    return juce::Font(juce::FontOptions(height, style));
#else
    return juce::Font(height, style);
#endif
}
} // namespace

const Palette& paletteOf(bool dark) noexcept
{
    // Text on card: contrast 12:1 (dark) and 14:1 (light); dim text 5:1 on both.
    static const Palette darkOne{juce::Colour(0xff16191d), juce::Colour(0xff1f242a), juce::Colour(0xff14171b),
                                 juce::Colour(0xff343b44), juce::Colour(0xffe6e9ec), juce::Colour(0xff97a1ac),
                                 juce::Colour(0xff3fc1a6), juce::Colour(0xffe8a33d)};
    static const Palette lightOne{juce::Colour(0xffeceef0), juce::Colour(0xfffbfcfc), juce::Colour(0xffe4e7ea),
                                  juce::Colour(0xffc6ccd2), juce::Colour(0xff1b2026), juce::Colour(0xff5b6570),
                                  juce::Colour(0xff0c7f69), juce::Colour(0xffa86408)};
    return dark ? darkOne : lightOne;
}

Look::Look()
{
    setDark(true);
}

void Look::setDark(bool dark)
{
    darkNow = dark;
    const Palette& p = palette();
    setColour(juce::ResizableWindow::backgroundColourId, p.background);
    setColour(juce::DocumentWindow::textColourId, p.text);
    setColour(juce::Label::textColourId, p.text);
    setColour(juce::Slider::textBoxTextColourId, p.text);
    setColour(juce::Slider::textBoxOutlineColourId, juce::Colours::transparentBlack);
    setColour(juce::Slider::textBoxHighlightColourId, p.accent.withAlpha(0.4f));
    setColour(juce::ComboBox::textColourId, p.text);
    setColour(juce::ComboBox::arrowColourId, p.dim);
    setColour(juce::PopupMenu::backgroundColourId, p.card);
    setColour(juce::PopupMenu::textColourId, p.text);
    setColour(juce::PopupMenu::headerTextColourId, p.dim);
    setColour(juce::PopupMenu::highlightedBackgroundColourId, p.accent);
    setColour(juce::PopupMenu::highlightedTextColourId, p.card);
    setColour(juce::TextButton::textColourOffId, p.text);
    setColour(juce::TextButton::textColourOnId, p.card);
    setColour(juce::ToggleButton::textColourId, p.text);
    setColour(juce::TooltipWindow::backgroundColourId, p.well);
    setColour(juce::TooltipWindow::textColourId, p.text);
    setColour(juce::TooltipWindow::outlineColourId, p.line);
    setColour(juce::TextEditor::backgroundColourId, p.well);
    setColour(juce::TextEditor::textColourId, p.text);
    setColour(juce::TextEditor::outlineColourId, p.line);
    setColour(juce::TextEditor::focusedOutlineColourId, p.accent);
    setColour(juce::TextEditor::highlightColourId, p.accent.withAlpha(0.4f));
    setColour(juce::TextEditor::highlightedTextColourId, p.text);
    setColour(juce::CaretComponent::caretColourId, p.text);
    setColour(juce::ListBox::backgroundColourId, p.well);
    setColour(juce::ListBox::textColourId, p.text);
    setColour(juce::ListBox::outlineColourId, p.line);
    setColour(juce::AlertWindow::backgroundColourId, p.card);
    setColour(juce::AlertWindow::textColourId, p.text);
    setColour(juce::ScrollBar::thumbColourId, p.dim);
}

void Look::drawRotarySlider(juce::Graphics& g, int x, int y, int width, int height, float place, float startAngle,
                            float endAngle, juce::Slider& slider)
{
    const Palette& p = palette();
    const auto area = juce::Rectangle<int>(x, y, width, height).toFloat().reduced(3.0f);
    const float radius = std::min(0.5f * std::min(area.getWidth(), area.getHeight()), largestKnob);
    const auto centre = area.getCentre();
    const float thickness = std::max(2.5f, 0.13f * radius);
    const float ring = radius - 0.5f * thickness;
    const juce::PathStrokeType stroke(thickness, juce::PathStrokeType::curved, juce::PathStrokeType::rounded);
    const bool enabled = slider.isEnabled();

    juce::Path way;
    way.addCentredArc(centre.x, centre.y, ring, ring, 0.0f, startAngle, endAngle, true);
    g.setColour(p.line);
    g.strokePath(way, stroke);

    // From the value that a double click restores, so that the eye sees what was changed.
    const auto origin = static_cast<float>(slider.valueToProportionOfLength(slider.getDoubleClickReturnValue()));
    const float from = startAngle + origin * (endAngle - startAngle);
    const float to = startAngle + place * (endAngle - startAngle);
    if (std::abs(to - from) > 0.01f)
    {
        juce::Path part;
        part.addCentredArc(centre.x, centre.y, ring, ring, 0.0f, std::min(from, to), std::max(from, to), true);
        g.setColour(enabled ? p.accent : p.dim);
        g.strokePath(part, stroke);
    }

    const float inner = ring - 1.6f * thickness;
    g.setColour(p.well);
    g.fillEllipse(juce::Rectangle<float>(2.0f * inner, 2.0f * inner).withCentre(centre));
    const auto tip = centre.getPointOnCircumference(inner * 0.86f, to);
    const auto root = centre.getPointOnCircumference(inner * 0.42f, to);
    g.setColour(enabled ? p.text : p.dim);
    g.drawLine({root, tip}, 2.0f);
    drawFocusRing(g, slider, slider.getLocalBounds().toFloat());
}

void Look::drawLinearSlider(juce::Graphics& g, int x, int y, int width, int height, float position, float, float,
                            juce::Slider::SliderStyle, juce::Slider& slider)
{
    const Palette& p = palette();
    const auto area = juce::Rectangle<int>(x, y, width, height).toFloat();
    const float middle = area.getCentreY();
    const float left = area.getX();
    const float right = area.getRight();
    const auto origin = static_cast<float>(slider.valueToProportionOfLength(slider.getDoubleClickReturnValue()));
    const float from = left + origin * (right - left);
    const bool enabled = slider.isEnabled();
    g.setColour(p.line);
    g.fillRoundedRectangle({left, middle - 2.0f, right - left, 4.0f}, 2.0f);
    g.setColour(enabled ? p.accent : p.dim);
    g.fillRoundedRectangle({std::min(from, position), middle - 2.0f, std::abs(position - from), 4.0f}, 2.0f);
    g.setColour(p.dim);
    g.fillRect(juce::Rectangle<float>(from - 0.5f, middle - 5.0f, 1.0f, 10.0f));
    g.setColour(enabled ? p.text : p.dim);
    g.fillEllipse(juce::Rectangle<float>(12.0f, 12.0f).withCentre({position, middle}));
    drawFocusRing(g, slider, slider.getLocalBounds().toFloat());
}

void Look::drawToggleButton(juce::Graphics& g, juce::ToggleButton& button, bool highlighted, bool)
{
    const Palette& p = palette();
    const auto area = button.getLocalBounds().toFloat().reduced(1.0f);
    const bool on = button.getToggleState();
    g.setColour(on ? p.warning : p.well);
    g.fillRoundedRectangle(area, 4.0f);
    g.setColour(highlighted ? p.dim : p.line);
    g.drawRoundedRectangle(area.reduced(0.5f), 4.0f, 1.0f);
    g.setColour(on ? p.card : p.text);
    g.setFont(smallFont());
    g.drawFittedText(button.getButtonText(), button.getLocalBounds().reduced(4, 0), juce::Justification::centred, 1);
    drawFocusRing(g, button, button.getLocalBounds().toFloat());
}

void Look::drawButtonBackground(juce::Graphics& g, juce::Button& button, const juce::Colour&, bool highlighted,
                                bool down)
{
    const Palette& p = palette();
    const auto area = button.getLocalBounds().toFloat().reduced(0.5f);
    const bool on = button.getToggleState();
    g.setColour(on ? p.text : down ? p.line : p.well);
    g.fillRoundedRectangle(area, 4.0f);
    g.setColour(highlighted ? p.dim : p.line);
    g.drawRoundedRectangle(area, 4.0f, 1.0f);
    if (on)
    {
        // By light and dark and by shape, whatever colours are told apart.
        g.setColour(p.card);
        g.fillRoundedRectangle(area.reduced(grid, 0.0f).removeFromBottom(5.0f).removeFromTop(2.5f), 1.0f);
    }
    drawFocusRing(g, button, on ? area.reduced(1.5f) : button.getLocalBounds().toFloat());
}

void Look::drawComboBox(juce::Graphics& g, int width, int height, bool, int, int, int, int, juce::ComboBox& box)
{
    const Palette& p = palette();
    const auto area = juce::Rectangle<int>(width, height).toFloat().reduced(0.5f);
    g.setColour(p.well);
    g.fillRoundedRectangle(area, 4.0f);
    g.setColour(p.line);
    g.drawRoundedRectangle(area, 4.0f, 1.0f);
    juce::Path arrow;
    const float x = area.getRight() - 14.0f;
    const float y = area.getCentreY();
    arrow.startNewSubPath(x - 4.0f, y - 2.0f);
    arrow.lineTo(x, y + 2.0f);
    arrow.lineTo(x + 4.0f, y - 2.0f);
    g.setColour(p.dim);
    g.strokePath(arrow, juce::PathStrokeType(1.5f));
    drawFocusRing(g, box, area);
}

void Look::positionComboBoxText(juce::ComboBox& box, juce::Label& label)
{
    label.setBounds(grid, 1, box.getWidth() - 4 * grid, box.getHeight() - 2);
    label.setFont(getComboBoxFont(box));
}

juce::Font Look::getComboBoxFont(juce::ComboBox&)
{
    return usualFont();
}

juce::Font Look::getMenuBarFont(juce::MenuBarComponent&, int, const juce::String&)
{
    return usualFont();
}

juce::Font Look::getPopupMenuFont()
{
    return usualFont();
}

juce::Font Look::getTextButtonFont(juce::TextButton&, int)
{
    return usualFont();
}

juce::Font Look::getLabelFont(juce::Label& label)
{
    return label.getProperties().contains(quietProperty) ? smallFont() : label.getFont();
}

juce::Label* Look::createSliderTextBox(juce::Slider& slider)
{
    auto* label = juce::LookAndFeel_V4::createSliderTextBox(slider);
    label->setFont(smallFont());
    label->getProperties().set(quietProperty, true);
    label->setColour(juce::Label::backgroundColourId, juce::Colours::transparentBlack);
    label->setColour(juce::Label::backgroundWhenEditingColourId, palette().well);
    label->setBorderSize({});
    return label;
}

void Look::drawMenuBarBackground(juce::Graphics& g, int width, int height, bool, juce::MenuBarComponent&)
{
    g.setColour(palette().card);
    g.fillRect(0, 0, width, height);
}

int Look::getTabButtonBestWidth(juce::TabBarButton& tab, int)
{
    // All alike, over the whole bar.
    const auto& bar = tab.getTabbedButtonBar();
    return bar.getWidth() / std::max(1, bar.getNumTabs());
}

void Look::drawTabButton(juce::TabBarButton& tab, juce::Graphics& g, bool over, bool)
{
    const Palette& p = palette();
    const auto area = tab.getLocalBounds();
    const bool front = tab.isFrontTab();
    g.setColour(front ? p.text : over ? p.text.withAlpha(0.85f) : p.dim);
    g.setFont(usualFont());
    g.drawText(tab.getButtonText(), area, juce::Justification::centred);
    if (front)
    {
        g.setColour(p.accent);
        g.fillRect(area.withTop(area.getBottom() - 3).reduced(grid, 0));
    }
    if (tab.hasKeyboardFocus(false))
        drawFocusRing(g, tab, area.toFloat().reduced(2.0f));
}

void Look::drawTabAreaBehindFrontButton(juce::TabbedButtonBar&, juce::Graphics& g, int width, int height)
{
    g.setColour(palette().line);
    g.fillRect(0, height - 1, width, 1);
}

void Look::drawLabel(juce::Graphics& g, juce::Label& label)
{
    if (label.isBeingEdited())
        return;
    g.fillAll(label.findColour(juce::Label::backgroundColourId));
    g.setColour(label.findColour(juce::Label::textColourId).withMultipliedAlpha(label.isEnabled() ? 1.0f : 0.6f));
    g.setFont(getLabelFont(label));
    g.drawFittedText(label.getText(), label.getLocalBounds(), label.getJustificationType(), 1, 0.8f);
}

const Palette& paletteFor(const juce::Component& component)
{
    const auto* look = dynamic_cast<const Look*>(&component.getLookAndFeel());
    return look ? look->palette() : paletteOf(true);
}

bool findJapaneseFont()
{
    return japaneseFont().isThere();
}

void useFontOf(const juce::String& language)
{
    japaneseNow = language == "ja" && findJapaneseFont();
    // All fonts without a name get this one, those of JUCE's own components, too.
    juce::LookAndFeel::getDefaultLookAndFeel().setDefaultSansSerifTypefaceName(japaneseNow ? japaneseFont().name
                                                                                           : juce::String());
    juce::Typeface::clearTypefaceCache();
}

juce::Font smallFont()
{
    return fontOf(13.0f, false);
}

juce::Font usualFont()
{
    return fontOf(14.5f, false);
}

juce::Font titleFont()
{
    return fontOf(20.0f, true);
}

juce::Rectangle<int> insideOfCard(juce::Rectangle<int> area) noexcept
{
    return area.reduced(2 * grid, grid).withTrimmedTop(3 * grid);
}

juce::Rectangle<int> drawCard(juce::Graphics& g, juce::Rectangle<int> area, const juce::String& name,
                              const Palette& palette)
{
    g.setColour(palette.card);
    g.fillRoundedRectangle(area.toFloat(), 6.0f);
    g.setColour(palette.dim);
    g.setFont(fontOf(13.0f, true));
    g.drawText(tr(name), area.reduced(2 * grid, grid).withHeight(2 * grid), juce::Justification::centredLeft, true);
    return insideOfCard(area);
}

void drawFocusRing(juce::Graphics& g, const juce::Component& component, juce::Rectangle<float> around)
{
    if (!component.hasKeyboardFocus(true))
        return;
    g.setColour(paletteFor(component).accent.withAlpha(0.8f));
    g.drawRoundedRectangle(around.reduced(1.0f), 4.0f, 1.5f);
}

} // namespace pacini::editor
