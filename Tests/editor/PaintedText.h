#pragma once

// What components write when they are painted, whoever writes it: labels, menus, buttons, and code of their own.

#include "editor/Fonts.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <algorithm>

namespace pacini::test
{

#if JUCE_LINUX && JUCE_MAJOR_VERSION < 8 // where the number of a glyph is its character

/// Paints and keeps the texts, of which each is on one line.
class TextRecorder final : public juce::LowLevelGraphicsSoftwareRenderer
{
public:
    explicit TextRecorder(const juce::Image& image) : juce::LowLevelGraphicsSoftwareRenderer(image) {}

    void setFont(const juce::Font& font) override
    {
        endText();
        juce::LowLevelGraphicsSoftwareRenderer::setFont(font);
    }
    void drawGlyph(int glyph, const juce::AffineTransform& where) override
    {
        if (where.getTranslationY() != line || where.getTranslationX() < last)
            endText();
        line = where.getTranslationY();
        last = where.getTranslationX();
        now += static_cast<juce::juce_wchar>(glyph);
        juce::LowLevelGraphicsSoftwareRenderer::drawGlyph(glyph, where);
    }
    [[nodiscard]] const juce::StringArray& texts()
    {
        endText();
        return found;
    }

private:
    void endText()
    {
        if (now.isNotEmpty())
            found.add(now);
        now = {};
    }
    juce::StringArray found;
    juce::String now;
    float line = 0.0f, last = 0.0f;
};

inline juce::StringArray paintedTexts(juce::Component& component)
{
    juce::Image image(juce::Image::RGB, std::max(1, component.getWidth()), std::max(1, component.getHeight()), true,
                      juce::SoftwareImageType());
    TextRecorder recorder(image);
    juce::Graphics g(recorder);
    component.paintEntireComponent(g, true);
    return recorder.texts();
}

/// Adds texts that had no room: JUCE puts dots in the place of what is left out. Our own texts have an ellipsis of one
/// character. Texts that begin with one of `names` may be longer than any room.
inline void addCutTexts(juce::Component& component, const juce::String& where, const juce::StringArray& names,
                        juce::StringArray& found)
{
    const auto isName = [&names](const juce::String& text)
    {
        for (const auto& name : names)
            if (text.startsWith(name))
                return true;
        return false;
    };
    for (const auto& text : paintedTexts(component))
        if (text.endsWith("..") && !isName(text))
            found.addIfNotAlreadyThere(where + ": " + text);
}

/// Adds items that their menus have no room for when they are chosen. `names` are what things are called, which may be
/// longer than any room; what ends in an ellipsis opens a sheet and is never shown as chosen.
inline void addCutItems(juce::Component& root, const juce::String& where, const juce::StringArray& names,
                        juce::StringArray& found)
{
    if (auto* box = dynamic_cast<juce::ComboBox*>(&root); box != nullptr && box->isVisible() && box->getWidth() > 0)
        for (auto* child : box->getChildren())
            if (auto* label = dynamic_cast<juce::Label*>(child))
                for (int i = 0; i < box->getNumItems(); ++i)
                    if (const auto item = box->getItemText(i);
                        !names.contains(item) && !item.endsWithChar(0x2026) &&
                        std::min(label->getFont().getStringWidth(item), editor::smallFont().getStringWidth(item)) >
                            label->getWidth())
                        found.addIfNotAlreadyThere(where + ", " + box->getTitle() + ": " + item);
    for (auto* child : root.getChildren())
        addCutItems(*child, where, names, found);
}

#endif

/// Adds pairs of controls of one parent that lie on each other.
inline void addOverlaps(juce::Component& root, const juce::String& where, juce::StringArray& found)
{
    const auto isControl = [](juce::Component* one)
    {
        return one->isVisible() && !one->getBounds().isEmpty() &&
               (dynamic_cast<juce::Button*>(one) != nullptr || dynamic_cast<juce::ComboBox*>(one) != nullptr ||
                dynamic_cast<juce::Slider*>(one) != nullptr || dynamic_cast<juce::Label*>(one) != nullptr ||
                dynamic_cast<juce::TextEditor*>(one) != nullptr);
    };
    const auto nameOf = [](juce::Component* one)
    {
        const auto* label = dynamic_cast<juce::Label*>(one);
        return label != nullptr ? label->getText() : one->getTitle() + one->getName();
    };
    const auto& children = root.getChildren();
    for (int i = 0; i < children.size(); ++i)
    {
        if (children[i]->isVisible())
            addOverlaps(*children[i], where, found);
        for (int k = 0; k < i; ++k)
            if (isControl(children[i]) && isControl(children[k]) &&
                children[i]->getBounds().intersects(children[k]->getBounds()))
                found.addIfNotAlreadyThere(where + ": " + nameOf(children[i]) + " lies on " + nameOf(children[k]));
    }
}

} // namespace pacini::test
