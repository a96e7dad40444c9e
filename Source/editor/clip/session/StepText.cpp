// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/StepText.h"

#include "editor/Text.h"
#include "editor/Translation.h"

namespace pacini::editor
{

namespace
{
/// # stands for the number.
struct Words
{
    const char *point, *points, *transient, *transients, *both;
};

Words wordsOf(SelectionStep step)
{
    switch (step)
    {
    case SelectionStep::move:
        break;
    case SelectionStep::remove:
        return {"Delete point", "Delete # points", "Delete transient", "Delete # transients",
                "Delete # points and transients"};
    case SelectionStep::scale:
        return {"Scale point", "Scale # points", "Scale transient", "Scale # transients",
                "Scale # points and transients"};
    case SelectionStep::setValue:
        return {"Set value of point", "Set value of # points", "Set value of transient", "Set value of # transients",
                "Set value of # points and transients"};
    case SelectionStep::setSharpness:
        return {"Set sharpness of point", "Set sharpness of # points", "Set sharpness of transient",
                "Set sharpness of # transients", "Set sharpness of # points and transients"};
    }
    return {"Move point", "Move # points", "Move transient", "Move # transients", "Move # points and transients"};
}
} // namespace

std::string stepName(SelectionStep step, const Selection& changed)
{
    const Words words = wordsOf(step);
    const std::size_t count = selectedCount(changed);
    const std::size_t events = changed.transients.size();
    if (count == 1)
        return events == 0 ? words.point : words.transient;
    const juce::String pattern = events == 0 ? words.points : events == count ? words.transients : words.both;
    return pattern.replace("#", juce::String(static_cast<juce::int64>(count))).toStdString();
}

juce::String stepText(const std::string& name)
{
    const juce::String text = toText(name);
    const juce::String digits = "0123456789";
    const int first = text.indexOfAnyOf(digits);
    if (first < 0)
        return tr(text);
    const juce::String number = text.substring(first).initialSectionContainingOnly(digits);
    const juce::String pattern = text.substring(0, first) + "#" + text.substring(first + number.length());
    return tr(pattern).replace("#", number);
}

juce::String commandWithStep(const char* command, const char* pattern, const std::string& name)
{
    if (name.empty())
        return tr(command);
    const juce::String step = stepText(name);
    const juce::String translated = tr(pattern);
    // English goes on in small letters; other languages say where the step stands.
    return translated.replace("{step}",
                              translated == pattern ? step.substring(0, 1).toLowerCase() + step.substring(1) : step);
}

} // namespace pacini::editor
