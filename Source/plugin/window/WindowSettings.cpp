// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/window/WindowSettings.h"

#include <algorithm>

namespace pacini::plugin
{

namespace
{
constexpr const char* scaleName = "scale";
constexpr int usualScale = 100;

juce::PropertiesFile::Options writesAtOnce()
{
    juce::PropertiesFile::Options options;
    options.millisecondsBeforeSaving = 0;
    return options;
}
} // namespace

juce::File usualUserFolder()
{
    const auto folder = juce::File::getSpecialLocation(juce::File::userApplicationDataDirectory);
#if JUCE_MAC
    return folder.getChildFile("Application Support").getChildFile("Pacini");
#else
    return folder.getChildFile("Pacini");
#endif
}

WindowSettings::WindowSettings(const juce::File& folder) : file(folder.getChildFile("window.settings"), writesAtOnce())
{
}

int WindowSettings::scale() const
{
    const int wanted = file.getIntValue(scaleName, usualScale);
    return std::find(scales.begin(), scales.end(), wanted) != scales.end() ? wanted : usualScale;
}

void WindowSettings::setScale(int percent)
{
    file.reload(); // another instance may have written it
    file.setValue(scaleName, percent);
    file.save();
}

} // namespace pacini::plugin
