// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/Settings.h"

namespace pacini::app
{

CommandLineWishes wishesOf(const juce::StringArray& arguments)
{
    CommandLineWishes wishes;
    for (int i = 0; i < arguments.size(); ++i)
    {
        const auto& name = arguments[i];
        const auto value = [&]
        {
            return arguments[++i].unquoted();
        };
        if (name == "--fresh")
            wishes.fresh = true;
        else if (name == "--test-signal")
            wishes.testSignal = true;
        else if (name == "--device-type")
            wishes.deviceType = value();
        else if (name == "--play")
            wishes.file = juce::File::getCurrentWorkingDirectory().getChildFile(value());
        else if (name == "--haptic-output")
            wishes.hapticOutput = value().getIntValue() - 1;
        else if (name == "--sound-output")
            wishes.soundOutput = value().getIntValue() - 1;
    }
    return wishes;
}

Routing routingOf(juce::PropertiesFile& settings)
{
    Routing routing;
    routing.input = static_cast<InputChoice>(juce::jlimit(0, 2, settings.getIntValue("input", 0)));
    routing.mainInput = settings.getIntValue("mainInput", routing.mainInput);
    routing.sidechainInput = settings.getIntValue("sidechainInput", routing.sidechainInput);
    routing.mainOutput = settings.getIntValue("mainOutput", routing.mainOutput);
    routing.hapticOutput = settings.getIntValue("hapticOutput", routing.hapticOutput);
    routing.hapticChannels = juce::jlimit(1, 2, settings.getIntValue("hapticChannels", routing.hapticChannels));
    return routing;
}

void remember(juce::PropertiesFile& settings, const Routing& routing)
{
    settings.setValue("input", static_cast<int>(routing.input));
    settings.setValue("mainInput", routing.mainInput);
    settings.setValue("sidechainInput", routing.sidechainInput);
    settings.setValue("mainOutput", routing.mainOutput);
    settings.setValue("hapticOutput", routing.hapticOutput);
    settings.setValue("hapticChannels", routing.hapticChannels);
}

} // namespace pacini::app
