// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sliders, buttons and child components, as all windows have them.

#include "editor/Theme.h"
#include "editor/Tokens.h"
#include "editor/Translation.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <utility>

namespace pacini::editor
{

/// A slider that leaves the wheel to the page that it is scrolled with: turning it there must not change a value.
class Slider : public juce::Slider
{
public:
    using juce::Slider::Slider;

    std::function<void()> onMenu; ///< the right button was pressed, which moves nothing then

    /// A dash in the place of the number: there is nothing that has one.
    void showNone(bool wanted)
    {
        if (std::exchange(none, wanted) != wanted)
            updateText();
    }

    // Numbers as the language writes them.
    juce::String getTextFromValue(double value) override
    {
        if (none)
            return juce::String::fromUTF8("–");
        return withDecimalMark(juce::Slider::getTextFromValue(value));
    }
    double getValueFromText(const juce::String& text) override
    {
        return juce::Slider::getValueFromText(withDecimalPoint(text));
    }

    void mouseDown(const juce::MouseEvent& event) override
    {
        asksForMenu = onMenu && event.mods.isPopupMenu();
        if (asksForMenu)
            onMenu();
        else
            juce::Slider::mouseDown(event);
    }
    void mouseDrag(const juce::MouseEvent& event) override
    {
        if (!asksForMenu)
            juce::Slider::mouseDrag(event);
    }
    void mouseUp(const juce::MouseEvent& event) override
    {
        if (!asksForMenu)
            juce::Slider::mouseUp(event);
    }
    void mouseWheelMove(const juce::MouseEvent& event, const juce::MouseWheelDetails& wheel) override
    {
        if (findParentComponentOfClass<juce::Viewport>() != nullptr)
            juce::Component::mouseWheelMove(event, wheel); // NOLINT(bugprone-parent-virtual-call): to the parent
        else
            juce::Slider::mouseWheelMove(event, wheel);
    }

private:
    bool asksForMenu = false;
    bool none = false;
};

/// A text field whose prompt, said in it while it is empty, follows the theme.
class PromptField final : public juce::TextEditor
{
public:
    using juce::TextEditor::TextEditor;

    void showWhenEmpty(const juce::String& words)
    {
        whenEmpty = words;
        follow();
    }
    void lookAndFeelChanged() override
    {
        juce::TextEditor::lookAndFeelChanged();
        follow();
    }
    void parentHierarchyChanged() override
    {
        juce::TextEditor::parentHierarchyChanged();
        follow();
    }

private:
    void follow() { setTextToShowWhenEmpty(whenEmpty, paletteFor(*this).dim); }
    juce::String whenEmpty;
};

/// A menu whose items do something: keys open it, where those of other boxes choose the next item at once.
class MenuBox final : public juce::ComboBox
{
public:
    bool keyPressed(const juce::KeyPress& key) override
    {
        const bool chooses = key.isKeyCode(juce::KeyPress::upKey) || key.isKeyCode(juce::KeyPress::downKey) ||
                             key.isKeyCode(juce::KeyPress::leftKey) || key.isKeyCode(juce::KeyPress::rightKey);
        if (!chooses)
            return juce::ComboBox::keyPressed(key);
        if (isShowing())
            showPopup();
        return true;
    }
    void mouseWheelMove(const juce::MouseEvent& event, const juce::MouseWheelDetails& wheel) override
    {
        juce::Component::mouseWheelMove(event, wheel); // NOLINT(bugprone-parent-virtual-call): to the parent
    }
};

inline void prepareButton(juce::Button& button, const juce::String& tooltip, std::function<void()> click)
{
    button.setTooltip(tooltip);
    button.onClick = std::move(click);
}

/// Sets up the label beside a control; screen readers have the control's own title.
inline void prepareLabel(juce::Label& label, const juce::String& text, const juce::Font& font)
{
    label.setText(text, juce::dontSendNotification);
    label.setFont(font);
    label.setAccessible(false);
}

/// The width of a button that shows all of its text, at least `least`.
[[nodiscard]] inline int buttonWidth(juce::TextButton& button, int least = 0)
{
    const auto font = button.getLookAndFeel().getTextButtonFont(button, 24);
    return std::max(least, font.getStringWidth(button.getButtonText()) + 24);
}

/// The width of a menu that shows all of each item.
[[nodiscard]] inline int boxWidth(juce::ComboBox& box)
{
    const auto font = box.getLookAndFeel().getComboBoxFont(box);
    int widest = 0;
    for (int i = 0; i < box.getNumItems(); ++i)
        widest = std::max(widest, font.getStringWidth(box.getItemText(i)));
    return widest + 32; // the arrow and both ends
}

/// A menu and its name on one line; the menu alone where its items leave no room for the name.
inline void placeNamed(juce::Label& name, int nameWidth, juce::ComboBox& box, juce::Rectangle<int> line)
{
    const bool room = boxWidth(box) <= line.getWidth() - nameWidth;
    name.setVisible(room);
    name.setBounds(room ? line.removeFromLeft(nameWidth) : juce::Rectangle<int>());
    box.setBounds(line);
}

/// The width of a column of labels that shows all of their texts, `least` to `most`; `most` where that is less, as
/// before a sheet has its size.
[[nodiscard]] inline int labelsWidth(std::initializer_list<const juce::Label*> labels, int least, int most)
{
    int widest = 0;
    for (const juce::Label* label : labels)
        widest = std::max(widest, label->getFont().getStringWidth(label->getText()));
    return std::min(std::max(widest + 8, least), most);
}

/// A slider, its name, and the width of its number where that stands at the right end of the track.
struct NamedSlider
{
    juce::Label& name;
    juce::Slider& slider;
    int numberWidth;
};

/// Whether sliders with names of `namesWidth` at their left have room for their tracks in lines of this width.
[[nodiscard]] inline bool hasTracks(std::initializer_list<NamedSlider> sliders, int namesWidth, int lineWidth)
{
    return std::all_of(sliders.begin(), sliders.end(),
                       [&](const NamedSlider& one)
                       {
                           const int ends = 2 * one.slider.getLookAndFeel().getSliderThumbRadius(one.slider);
                           return lineWidth - namesWidth - one.numberWidth - ends >= space::leastTrack;
                       });
}

/// A horizontal slider and its name on one line of its parent; `stacked`, for lines without room for the track: the
/// name and the number above the track.
inline void placeSlider(const NamedSlider& one, int nameWidth, juce::Rectangle<int> line, bool stacked)
{
    auto* parent = one.slider.getParentComponent();
    const auto style = stacked ? juce::Slider::TextBoxAbove : juce::Slider::TextBoxRight;
    const int numberHeight = stacked ? std::min(2 * grid, line.getHeight() - 12) : line.getHeight();
    if (one.slider.getTextBoxPosition() != style || one.slider.getTextBoxHeight() != numberHeight)
        one.slider.setTextBoxStyle(style, false, one.numberWidth, numberHeight);
    // The name lies in the slider then: a click on it is none on the track.
    auto* holder = stacked ? &one.slider : parent;
    if (holder != nullptr && one.name.getParentComponent() != holder)
        holder->addAndMakeVisible(one.name);
    if (stacked)
        one.name.setBounds(0, 0, line.getWidth() - one.numberWidth, numberHeight);
    else
        one.name.setBounds(line.removeFromLeft(nameWidth));
    one.slider.setBounds(line);
}

/// Adds children in this order, visible.
inline void addAll(juce::Component& parent, std::initializer_list<juce::Component*> children)
{
    for (juce::Component* child : children)
        parent.addAndMakeVisible(child);
}

} // namespace pacini::editor
