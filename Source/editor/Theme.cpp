// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/Theme.h"

#include "editor/Icons.h"
#include "editor/LineBreaks.h"
#include "editor/Translation.h"

#include <algorithm>
#include <cmath>

namespace pacini::editor
{

namespace
{
const juce::Identifier quietProperty("quiet");
const juce::Identifier primaryProperty("primary");
const juce::Identifier originProperty("origin");
constexpr float sliderThumb = 12.0f;
constexpr float disabledAlpha = 0.45f;

/// Whether a value goes both ways.
bool hasOrigin(const juce::Slider& slider)
{
    return slider.getProperties().contains(originProperty) || (slider.getMinimum() < 0.0 && slider.getMaximum() > 0.0);
}

/// From where the value is drawn, 0 to 1 of the way.
float originOf(juce::Slider& slider)
{
    return hasOrigin(slider) ? static_cast<float>(slider.valueToProportionOfLength(
                                   slider.getProperties().getWithDefault(originProperty, 0.0)))
                             : 0.0f;
}

struct ButtonColours
{
    juce::Colour fill, border, text;
};

ButtonColours coloursOf(const juce::Button& button, const Palette& p, bool highlighted, bool down)
{
    const float alpha = button.isEnabled() ? 1.0f : disabledAlpha;
    const auto shade = [&](juce::Colour colour)
    {
        return down          ? colour.interpolatedWith(p.background, 0.18f)
               : highlighted ? colour.interpolatedWith(p.text, 0.08f)
                             : colour;
    };
    if (button.getToggleState())
        return {shade(p.accent).withMultipliedAlpha(alpha), juce::Colours::transparentBlack, p.onAccent};
    // One that cannot be pressed calls for nothing: it looks as all others do.
    if (button.isEnabled() && button.getProperties().contains(primaryProperty))
        return {p.primary.interpolatedWith(p.background, down          ? 0.22f
                                                         : highlighted ? 0.12f
                                                                       : 0.0f),
                juce::Colours::transparentBlack, p.onPrimary};
    return {shade(p.control).withMultipliedAlpha(alpha), p.line.withMultipliedAlpha(alpha),
            p.text.withMultipliedAlpha(alpha)};
}

juce::TextLayout layOutTooltip(const juce::String& text, juce::Colour colour)
{
    constexpr float widest = 50.0f * grid;
    juce::AttributedString words;
    words.setJustification(juce::Justification::topLeft);
    words.append(withLineBreaks(text, smallFont(), widest), smallFont(), colour);
    juce::TextLayout layout;
    layout.createLayoutWithBalancedLineLengths(words, widest);
    return layout;
}
} // namespace

const Palette& paletteOf(bool dark) noexcept
{
    return dark ? darkPalette : lightPalette;
}

bool systemIsDark()
{
#if JUCE_LINUX || JUCE_BSD
    if (juce::Desktop::getInstance().isDarkModeActive())
        return true;
    // JUCE sees a running settings daemon only; desktops also write their choice where programs of GTK find it.
    const juce::String theme = juce::SystemStats::getEnvironmentVariable("GTK_THEME", {});
    if (theme.isNotEmpty())
        return theme.containsIgnoreCase("dark");
    const juce::File home = juce::File::getSpecialLocation(juce::File::userHomeDirectory);
    for (const char* version : {"gtk-4.0", "gtk-3.0"})
    {
        const juce::String settings =
            home.getChildFile(".config").getChildFile(version).getChildFile("settings.ini").loadFileAsString();
        for (const auto& line : juce::StringArray::fromLines(settings))
        {
            const auto value = line.fromFirstOccurrenceOf("=", false, false).trim();
            if (line.startsWith("gtk-application-prefer-dark-theme"))
                return value == "1" || value == "true";
            if (line.startsWith("gtk-theme-name") && value.containsIgnoreCase("dark"))
                return true;
        }
        if (settings.isNotEmpty())
            return false;
    }
    return true;
#else
    return juce::Desktop::getInstance().isDarkModeActive();
#endif
}

void makePrimary(juce::Button& button, bool isPrimary)
{
    if (isPrimary == button.getProperties().contains(primaryProperty))
        return;
    if (isPrimary)
        button.getProperties().set(primaryProperty, true);
    else
        button.getProperties().remove(primaryProperty);
    button.repaint();
}

juce::Colour buttonTextColour(const juce::Button& button)
{
    return coloursOf(button, paletteFor(button), false, false).text;
}

void setOrigin(juce::Slider& slider, double value)
{
    slider.getProperties().set(originProperty, value);
}

Look::Look()
{
    installFonts();
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
    setColour(juce::PopupMenu::highlightedTextColourId, p.onAccent);
    setColour(juce::TextButton::textColourOffId, p.text);
    setColour(juce::TextButton::textColourOnId, p.onAccent);
    setColour(juce::ToggleButton::tickColourId, p.accent);
    setColour(juce::ToggleButton::tickDisabledColourId, p.dim);
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
    setColour(juce::FileChooserDialogBox::titleTextColourId, p.text);
    setColour(juce::FileBrowserComponent::currentPathBoxBackgroundColourId, p.control);
    setColour(juce::FileBrowserComponent::currentPathBoxTextColourId, p.text);
    setColour(juce::FileBrowserComponent::currentPathBoxArrowColourId, p.dim);
    setColour(juce::FileBrowserComponent::filenameBoxBackgroundColourId, p.well);
    setColour(juce::FileBrowserComponent::filenameBoxTextColourId, p.text);
    setColour(juce::DirectoryContentsDisplayComponent::textColourId, p.text);
    setColour(juce::DirectoryContentsDisplayComponent::highlightColourId, p.accent);
    setColour(juce::DirectoryContentsDisplayComponent::highlightedTextColourId, p.onAccent);
}

void Look::drawRotarySlider(juce::Graphics& g, int x, int y, int width, int height, float place, float startAngle,
                            float endAngle, juce::Slider& slider)
{
    const Palette& p = palette();
    const auto area = juce::Rectangle<int>(x, y, width, height).toFloat().reduced(2.0f);
    const auto centre = area.getCentre();
    const float radius = 0.5f * std::min({area.getWidth(), area.getHeight(), static_cast<float>(space::mostKnob)});
    const float thickness = std::max(3.0f, 0.11f * radius);
    const float ring = radius - 0.5f * thickness;
    const juce::PathStrokeType stroke(thickness, juce::PathStrokeType::curved, juce::PathStrokeType::rounded);
    const bool enabled = slider.isEnabled();
    const auto arc = [&](float from, float to, juce::Colour colour)
    {
        juce::Path path;
        path.addCentredArc(centre.x, centre.y, ring, ring, 0.0f, from, to, true);
        g.setColour(colour);
        g.strokePath(path, stroke);
    };
    const auto angle = [&](float proportion)
    {
        return startAngle + proportion * (endAngle - startAngle);
    };
    arc(startAngle, endAngle, p.line);
    const float origin = angle(originOf(slider)), value = angle(place);
    if (std::abs(value - origin) > 0.01f)
        arc(std::min(origin, value), std::max(origin, value), enabled ? p.accent : p.dim.withAlpha(disabledAlpha));
    else if (hasOrigin(slider))
        arc(origin - 0.02f, origin + 0.02f, enabled ? p.accent : p.dim);

    const float inner = ring - 1.4f * thickness;
    g.setColour(slider.isMouseOverOrDragging() && enabled ? p.control.interpolatedWith(p.text, 0.08f) : p.control);
    g.fillEllipse(juce::Rectangle<float>(2.0f * inner, 2.0f * inner).withCentre(centre));
    const auto tip = centre.getPointOnCircumference(inner * 0.88f, value);
    const auto root = centre.getPointOnCircumference(inner * 0.40f, value);
    juce::Path pointer;
    pointer.startNewSubPath(root);
    pointer.lineTo(tip);
    g.setColour(enabled ? p.text : p.dim);
    g.strokePath(pointer, juce::PathStrokeType(2.2f, juce::PathStrokeType::curved, juce::PathStrokeType::rounded));
    drawFocusRing(g, slider, slider.getLocalBounds().toFloat());
}

/// A knob has its number right below it, however tall its box is. A slider whose number is above its track has it at
/// the right end, since the slider's name stands at the left one.
juce::Slider::SliderLayout Look::getSliderLayout(juce::Slider& slider)
{
    auto layout = juce::LookAndFeel_V4::getSliderLayout(slider);
    if (slider.isRotary() && slider.getTextBoxPosition() == juce::Slider::TextBoxBelow)
    {
        const int text = slider.getTextBoxHeight();
        const int knob = std::min({slider.getWidth(), slider.getHeight() - text, space::mostKnob + 4});
        const int top = std::max(0, (slider.getHeight() - knob - text) / 2);
        layout.sliderBounds = {(slider.getWidth() - knob) / 2, top, knob, knob};
        layout.textBoxBounds = {0, top + knob, slider.getWidth(), text};
    }
    if (slider.isHorizontal() && slider.getTextBoxPosition() == juce::Slider::TextBoxAbove)
    {
        auto area = slider.getLocalBounds();
        layout.textBoxBounds = area.removeFromTop(slider.getTextBoxHeight()).removeFromRight(slider.getTextBoxWidth());
        layout.sliderBounds = area.reduced(static_cast<int>(sliderThumb) / 2, 0); // in line with both texts
    }
    return layout;
}

void Look::drawLinearSlider(juce::Graphics& g, int x, int y, int width, int height, float position, float, float,
                            juce::Slider::SliderStyle, juce::Slider& slider)
{
    const Palette& p = palette();
    const auto area = juce::Rectangle<int>(x, y, width, height).toFloat();
    const float middle = area.getCentreY();
    const float left = area.getX();
    const float right = area.getRight();
    const float from = left + originOf(slider) * (right - left);
    const bool enabled = slider.isEnabled();
    g.setColour(p.line);
    g.fillRoundedRectangle({left, middle - 2.0f, right - left, 4.0f}, 2.0f);
    g.setColour(enabled ? p.accent : p.dim.withAlpha(disabledAlpha));
    g.fillRoundedRectangle({std::min(from, position), middle - 2.0f, std::abs(position - from), 4.0f}, 2.0f);
    if (hasOrigin(slider))
    {
        g.setColour(p.dim);
        g.fillRect(juce::Rectangle<float>(from - 0.5f, middle - 5.0f, 1.0f, 10.0f));
    }
    g.setColour(enabled ? p.text : p.dim);
    g.fillEllipse(juce::Rectangle<float>(sliderThumb, sliderThumb).withCentre({position, middle}));
    drawFocusRing(g, slider, slider.getLocalBounds().toFloat());
}

void Look::drawToggleButton(juce::Graphics& g, juce::ToggleButton& button, bool highlighted, bool down)
{
    drawButtonBackground(g, button, {}, highlighted, down);
    g.setColour(coloursOf(button, palette(), highlighted, down).text);
    g.setFont(button.getHeight() < space::controlHeight ? smallFont() : usualFont()); // as other buttons beside it
    g.drawText(button.getButtonText(), button.getLocalBounds().reduced(3, 0), juce::Justification::centred, true);
}

void Look::drawButtonBackground(juce::Graphics& g, juce::Button& button, const juce::Colour&, bool highlighted,
                                bool down)
{
    // "On" differs by light and dark, whatever colours are told apart.
    const auto shown = coloursOf(button, palette(), highlighted, down);
    const auto area = button.getLocalBounds().toFloat().reduced(0.5f);
    juce::Path shape;
    shape.addRoundedRectangle(area.getX(), area.getY(), area.getWidth(), area.getHeight(), space::corner, space::corner,
                              !button.isConnectedOnLeft(), !button.isConnectedOnRight(), !button.isConnectedOnLeft(),
                              !button.isConnectedOnRight());
    g.setColour(shown.fill);
    g.fillPath(shape);
    g.setColour(shown.border);
    g.strokePath(shape, juce::PathStrokeType(1.0f));
    const bool filled = shown.border.isTransparent(); // its colour would hide the ring
    drawFocusRing(g, button, filled ? area.reduced(1.5f) : button.getLocalBounds().toFloat(),
                  filled ? std::optional(shown.text) : std::nullopt);
}

void Look::drawButtonText(juce::Graphics& g, juce::TextButton& button, bool highlighted, bool down)
{
    g.setColour(coloursOf(button, palette(), highlighted, down).text);
    const auto area = button.getLocalBounds().reduced(grid / 2, 0);
    // In less type before it is cut.
    g.setFont(fittingFont(button.getButtonText(), area.getWidth(), {usualFont(), smallFont()}));
    g.drawText(button.getButtonText(), area, juce::Justification::centred, true);
}

void Look::drawTickBox(juce::Graphics& g, juce::Component& component, float x, float y, float w, float h, bool ticked,
                       bool enabled, bool, bool)
{
    const Palette& p = palette();
    const auto box = juce::Rectangle<float>(x, y, w, h).reduced(0.5f);
    g.setColour((ticked ? p.accent : p.well).withMultipliedAlpha(enabled ? 1.0f : disabledAlpha));
    g.fillRoundedRectangle(box, 3.0f);
    g.setColour(p.dim);
    if (!ticked)
        g.drawRoundedRectangle(box, 3.0f, 1.0f);
    g.setColour(p.onAccent);
    if (ticked)
        drawIcon(g, Icon::tick, box);
    drawFocusRing(g, component, component.getLocalBounds().toFloat());
}

void Look::drawScrollbar(juce::Graphics& g, juce::ScrollBar& bar, int x, int y, int width, int height, bool vertical,
                         int thumbStart, int thumbSize, bool over, bool down)
{
    if (thumbSize <= 0 || thumbSize >= (vertical ? height : width))
        return;
    const auto thumb = vertical ? juce::Rectangle<int>(x, thumbStart, width, thumbSize)
                                : juce::Rectangle<int>(thumbStart, y, thumbSize, height);
    const auto area = thumb.toFloat().reduced(over || down ? 1.0f : 2.0f);
    g.setColour(palette().dim.withAlpha(bar.isEnabled() ? (down ? 0.8f : over ? 0.6f : 0.35f) : 0.2f));
    g.fillRoundedRectangle(area, 0.5f * std::min(area.getWidth(), area.getHeight()));
}

void Look::drawComboBox(juce::Graphics& g, int width, int height, bool, int, int, int, int, juce::ComboBox& box)
{
    const Palette& p = palette();
    const auto area = juce::Rectangle<int>(width, height).toFloat().reduced(0.5f);
    const float alpha = box.isEnabled() ? 1.0f : disabledAlpha;
    g.setColour((box.isMouseOver(true) && box.isEnabled() ? p.control.interpolatedWith(p.text, 0.08f) : p.control)
                    .withMultipliedAlpha(alpha));
    g.fillRoundedRectangle(area, space::corner);
    g.setColour(p.line.withMultipliedAlpha(alpha));
    g.drawRoundedRectangle(area, space::corner, 1.0f);
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
    label.setBounds(grid, 1, box.getWidth() - 3 * grid - 4, box.getHeight() - 2);
    label.setFont(getComboBoxFont(box));
}

/// Where the text of a chosen item stands.
void Look::drawComboBoxTextWhenNothingSelected(juce::Graphics& g, juce::ComboBox& box, juce::Label& label)
{
    g.setColour(palette().dim.withMultipliedAlpha(box.isEnabled() ? 1.0f : disabledAlpha));
    g.setFont(fittingFont(box.getTextWhenNothingSelected(), label.getWidth(), {getComboBoxFont(box), smallFont()}));
    g.drawText(box.getTextWhenNothingSelected(), label.getBounds(), juce::Justification::centredLeft, true);
}

/// The shortcut, or what else stands at the right, is secondary text of a size that can be read.
void Look::drawPopupMenuItem(juce::Graphics& g, const juce::Rectangle<int>& area, bool isSeparator, bool isActive,
                             bool isHighlighted, bool isTicked, bool hasSubMenu, const juce::String& text,
                             const juce::String& shortcut, const juce::Drawable* icon, const juce::Colour* colour)
{
    const Palette& p = palette();
    if (isSeparator)
    {
        g.setColour(p.line);
        g.fillRect(area.reduced(grid, 0).withSizeKeepingCentre(area.getWidth() - 2 * grid, 1));
        return;
    }
    auto row = area.reduced(1);
    const bool lit = isHighlighted && isActive;
    if (lit)
    {
        g.setColour(p.accent);
        g.fillRoundedRectangle(row.toFloat(), space::corner);
    }
    const auto shade = [&](juce::Colour usual)
    {
        return lit ? p.onAccent : usual.withMultipliedAlpha(isActive ? 1.0f : disabledAlpha);
    };
    row.reduce(grid / 2, 0);
    const auto sign = row.removeFromLeft(2 * grid + 4).toFloat();
    g.setColour(shade(p.text));
    if (icon != nullptr)
        icon->drawWithin(g, sign, juce::RectanglePlacement::centred, 1.0f);
    else if (isTicked)
        drawIcon(g, Icon::tick, sign);
    if (hasSubMenu)
    {
        const auto end = row.removeFromRight(2 * grid).toFloat();
        juce::Path arrow;
        arrow.startNewSubPath(end.getCentreX() - 2.0f, end.getCentreY() - 4.0f);
        arrow.lineTo(end.getCentreX() + 2.0f, end.getCentreY());
        arrow.lineTo(end.getCentreX() - 2.0f, end.getCentreY() + 4.0f);
        g.strokePath(arrow, juce::PathStrokeType(1.5f));
    }
    g.setColour(colour != nullptr && !lit ? *colour : shade(p.text));
    g.setFont(getPopupMenuFont());
    g.drawText(text, row, juce::Justification::centredLeft, true);
    if (shortcut.isEmpty())
        return;
    g.setColour(shade(p.dim));
    g.setFont(smallFont());
    g.drawText(shortcut, row.withTrimmedRight(grid / 2), juce::Justification::centredRight, true);
}

/// With all that drawPopupMenuItem() puts beside the text: tick, arrow and margins.
void Look::getIdealPopupMenuItemSize(const juce::String& text, bool isSeparator, int standardHeight, int& width,
                                     int& height)
{
    juce::LookAndFeel_V4::getIdealPopupMenuItemSize(text, isSeparator, standardHeight, width, height);
    constexpr int beside = 2 + grid + (2 * grid + 4) + 2 * grid + grid;
    if (!isSeparator)
        width = getPopupMenuFont().getStringWidth(text) + beside;
}

void Look::drawProgressBar(juce::Graphics& g, juce::ProgressBar&, int width, int height, double progress,
                           const juce::String& text)
{
    const Palette& p = palette();
    const auto area = juce::Rectangle<int>(width, height).toFloat();
    g.setColour(p.well);
    g.fillRoundedRectangle(area, space::corner);
    {
        const juce::Graphics::ScopedSaveState saved(g);
        juce::Path inside;
        inside.addRoundedRectangle(area, space::corner);
        g.reduceClipRegion(inside);
        g.setColour(p.accent.withAlpha(0.35f));
        if (progress >= 0.0)
            g.fillRect(area.withWidth(area.getWidth() * static_cast<float>(std::min(progress, 1.0))));
        else
        {
            // How long it takes is not known: a piece that goes from end to end.
            constexpr double period = 1500.0; // ms
            const auto place = static_cast<float>(std::fmod(juce::Time::getMillisecondCounterHiRes(), period) / period);
            const float piece = 0.25f * area.getWidth();
            g.fillRect(area.withWidth(piece).withX(place * (area.getWidth() + piece) - piece));
        }
    }
    g.setColour(p.line);
    g.drawRoundedRectangle(area.reduced(0.5f), space::corner, 1.0f);
    g.setColour(p.text);
    g.setFont(smallFont());
    g.drawText(text, area.reduced(static_cast<float>(grid) / 2.0f, 0.0f), juce::Justification::centred, true);
}

juce::Font Look::getComboBoxFont(juce::ComboBox& box)
{
    // Tall ones are those of a study's pages, whose labels are as large.
    constexpr int tall = 5 * grid;
    return box.getHeight() < tall ? usualFont() : usualFont().withHeight(17.0f);
}

juce::Font Look::getMenuBarFont(juce::MenuBarComponent&, int, const juce::String&)
{
    return usualFont();
}

void Look::drawMenuBarItem(juce::Graphics& g, int width, int height, int, const juce::String& text, bool over,
                           bool open, bool, juce::MenuBarComponent& bar)
{
    const Palette& p = palette();
    if (open || over)
    {
        g.setColour(open ? p.accent : p.control);
        g.fillRoundedRectangle(juce::Rectangle<int>(width, height).toFloat().reduced(1.0f, 2.0f), space::corner);
    }
    g.setColour((open ? p.onAccent : p.text).withMultipliedAlpha(bar.isEnabled() ? 1.0f : disabledAlpha));
    g.setFont(usualFont());
    g.drawText(text, 0, 0, width, height, juce::Justification::centred, true);
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
    if (slider.isHorizontal() && slider.getTextBoxPosition() == juce::Slider::TextBoxAbove)
        label->setJustificationType(juce::Justification::centredRight);
    return label;
}

/// Rounded as menus and buttons are; what is behind shows at the corners.
void Look::fillTextEditorBackground(juce::Graphics& g, int width, int height, juce::TextEditor& editor)
{
    editor.setOpaque(false);
    g.setColour(editor.findColour(juce::TextEditor::backgroundColourId));
    g.fillRoundedRectangle(juce::Rectangle<int>(width, height).toFloat().reduced(0.5f), space::corner);
}

void Look::drawTextEditorOutline(juce::Graphics& g, int width, int height, juce::TextEditor& editor)
{
    const bool focused =
        editor.isEnabled() && editor.hasKeyboardFocus(true); // what is only read is scrolled by keys, too
    const auto colour =
        editor.findColour(focused ? juce::TextEditor::focusedOutlineColourId : juce::TextEditor::outlineColourId);
    g.setColour(colour.withMultipliedAlpha(editor.isEnabled() ? 1.0f : disabledAlpha));
    const auto area = juce::Rectangle<int>(width, height).toFloat();
    if (focused)
        g.drawRoundedRectangle(area.reduced(1.0f), space::corner, 2.0f);
    else
        g.drawRoundedRectangle(area.reduced(0.5f), space::corner, 1.0f);
}

juce::Rectangle<int> Look::getTooltipBounds(const juce::String& text, juce::Point<int> pointer,
                                            juce::Rectangle<int> within)
{
    const auto layout = layOutTooltip(text, {});
    const int width = static_cast<int>(std::ceil(layout.getWidth())) + 2 * grid;
    const int height = static_cast<int>(std::ceil(layout.getHeight())) + grid;
    return juce::Rectangle<int>(pointer.x > within.getCentreX() ? pointer.x - (width + 12) : pointer.x + 24,
                                pointer.y > within.getCentreY() ? pointer.y - (height + 6) : pointer.y + 6, width,
                                height)
        .constrainedWithin(within);
}

/// With right angles: its window is opaque, so round corners would be black.
void Look::drawTooltip(juce::Graphics& g, const juce::String& text, int width, int height)
{
    const Palette& p = palette();
    g.fillAll(p.card);
    g.setColour(p.line);
    g.drawRect(0, 0, width, height);
    layOutTooltip(text, p.text).draw(g, juce::Rectangle<int>(width, height).reduced(grid, grid / 2).toFloat());
}

juce::Typeface::Ptr Look::getTypefaceForFont(const juce::Font& font)
{
    return typefaceFor(font);
}

/// With room for the word before the name in every language.
void Look::layoutFileBrowserComponent(juce::FileBrowserComponent& browser,
                                      juce::DirectoryContentsDisplayComponent* files,
                                      juce::FilePreviewComponent* preview, juce::ComboBox* path, juce::TextEditor* name,
                                      juce::Button* up)
{
    juce::LookAndFeel_V4::layoutFileBrowserComponent(browser, files, preview, path, name, up);
    name->setBounds(name->getBounds().withLeft(10 * grid));
}

void Look::drawMenuBarBackground(juce::Graphics& g, int width, int height, bool, juce::MenuBarComponent&)
{
    g.setColour(palette().card);
    g.fillRect(0, 0, width, height);
}

/// The whole bar, each tab as wide as its text and the same room beside it.
int Look::getTabButtonBestWidth(juce::TabBarButton& tab, int)
{
    const auto& bar = tab.getTabbedButtonBar();
    int texts = 0;
    for (const auto& name : bar.getTabNames())
        texts += usualFont().getStringWidth(name);
    const int room = (bar.getWidth() - texts) / std::max(1, bar.getNumTabs());
    return std::max(1, usualFont().getStringWidth(tab.getButtonText()) + room);
}

void Look::drawTabButton(juce::TabBarButton& tab, juce::Graphics& g, bool over, bool)
{
    const Palette& p = palette();
    const auto area = tab.getLocalBounds();
    const bool front = tab.isFrontTab();
    g.setColour(front ? p.text : over ? p.text.withAlpha(0.85f) : p.dim);
    g.setFont(usualFont());
    g.drawText(tab.getButtonText(), area, juce::Justification::centred, true);
    if (front)
    {
        g.setColour(p.accent);
        g.fillRect(area.withTop(area.getBottom() - 3).reduced(grid / 2, 0));
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
    // The text of a menu has one line, however tall its box is, in less type before it is cut.
    const bool ofBox = dynamic_cast<const juce::ComboBox*>(label.getParentComponent()) != nullptr;
    const juce::Font font =
        ofBox ? fittingFont(label.getText(), label.getWidth(), {label.getFont(), smallFont()}) : getLabelFont(label);
    const int lines = ofBox ? 1 : std::max(1, label.getHeight() / juce::roundToInt(font.getHeight()));
    g.setFont(font);
    g.drawFittedText(label.getText(), label.getLocalBounds(), label.getJustificationType(), lines);
}

const Palette& paletteFor(const juce::Component& component)
{
    const auto* look = dynamic_cast<const Look*>(&component.getLookAndFeel());
    return look ? look->palette() : paletteOf(true);
}

juce::Rectangle<int> insideOfCard(juce::Rectangle<int> area) noexcept
{
    return area.reduced(2 * grid, grid).withTrimmedTop(3 * grid);
}

juce::Rectangle<int> drawCard(juce::Graphics& g, juce::Rectangle<int> area, const juce::String& name,
                              const Palette& palette)
{
    g.setColour(palette.card);
    g.fillRoundedRectangle(area.toFloat(), space::cardCorner);
    g.setColour(palette.dim);
    g.setFont(smallFont().boldened());
    g.drawText(tr(name), area.reduced(2 * grid, grid).withHeight(2 * grid), juce::Justification::centredLeft, true);
    return insideOfCard(area);
}

void drawFocusRing(juce::Graphics& g, const juce::Component& component, juce::Rectangle<float> around,
                   std::optional<juce::Colour> colour)
{
    if (!component.hasKeyboardFocus(true))
        return;
    g.setColour(colour.value_or(paletteFor(component).accent));
    g.drawRoundedRectangle(around.reduced(1.0f), space::corner, 2.0f);
}

} // namespace pacini::editor
