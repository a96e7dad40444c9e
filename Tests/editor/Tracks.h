#pragma once

// What is too short of sliders, and languages without their fonts.

#include "editor/Text.h"
#include "editor/Tokens.h"
#include "editor/Translation.h"
#include "support/Paths.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <fstream>
#include <iterator>
#include <string>

namespace pacini::test
{

/// Sliders inside of `root` whose tracks are shorter than they may be, and names that are cut.
inline void addShortTracks(juce::Component& root, const juce::String& where, juce::StringArray& found)
{
    if (auto* slider = dynamic_cast<juce::Slider*>(&root);
        slider != nullptr && slider->isHorizontal() && slider->isVisible() && slider->getWidth() > 0)
    {
        const int track = slider->getLookAndFeel().getSliderLayout(*slider).sliderBounds.getWidth();
        if (track < editor::space::leastTrack)
            found.addIfNotAlreadyThere(where + ", " + slider->getTitle() + ": " + juce::String(track));
        for (auto* child : slider->getChildren())
            if (auto* label = dynamic_cast<juce::Label*>(child);
                label != nullptr && label->getFont().getStringWidth(label->getText()) > label->getWidth())
                found.addIfNotAlreadyThere(where + ", " + slider->getTitle() + ": " + label->getText() + " is cut");
    }
    for (auto* child : root.getChildren())
        addShortTracks(*child, where, found);
}

/// A language by its table: a machine for tests may lack the font.
inline void useTableOf(const juce::String& code)
{
    editor::useLanguage("en");
    if (code == "en")
        return;
    std::ifstream file(sourceFolder() / "Resources/translations" / (code + ".txt").toStdString(), std::ios::binary);
    editor::useTranslations(editor::toText(std::string(std::istreambuf_iterator<char>(file), {})));
}

} // namespace pacini::test
