// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/StepText.h"

#include "editor/Text.h"
#include "editor/Translation.h"

namespace pacini::editor
{

namespace
{
/// {0} is the number.
struct Words
{
    const char *point, *points, *event, *events, *both;
};

Words wordsOf(SelectionStep step)
{
    switch (step)
    {
    case SelectionStep::move:
        break;
    case SelectionStep::remove:
        return {"Delete point", "Delete {0} points", "Delete event", "Delete {0} events",
                "Delete {0} points and events"};
    case SelectionStep::scale:
        return {"Scale point", "Scale {0} points", "Scale event", "Scale {0} events", "Scale {0} points and events"};
    case SelectionStep::setValue:
        return {"Set value of point", "Set value of {0} points", "Set value of event", "Set value of {0} events",
                "Set value of {0} points and events"};
    case SelectionStep::setSharpness:
        return {"Set sharpness of point", "Set sharpness of {0} points", "Set sharpness of event",
                "Set sharpness of {0} events", "Set sharpness of {0} points and events"};
    }
    return {"Move point", "Move {0} points", "Move event", "Move {0} events", "Move {0} points and events"};
}
} // namespace

std::string stepName(SelectionStep step, const Selection& changed)
{
    const Words words = wordsOf(step);
    const std::size_t count = selectedCount(changed);
    const std::size_t events = changed.transients.size();
    if (count == 1)
        return events == 0 ? words.point : words.event;
    const juce::String pattern = events == 0 ? words.points : events == count ? words.events : words.both;
    return pattern.replace("{0}", juce::String(static_cast<juce::int64>(count))).toStdString();
}

juce::String stepText(const std::string& name)
{
    return translateMessage(toText(name));
}

juce::String commandWithStep(const char* command, const char* pattern, const std::string& name)
{
    if (name.empty())
        return tr(command);
    const juce::String step = stepText(name);
    const bool english = languageInUse() == "en"; // goes on in small letters
    return tr(pattern, {english ? step.substring(0, 1).toLowerCase() + step.substring(1) : step});
}

} // namespace pacini::editor
