// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/window/Plugin.h"

/// What JUCE's wrappers call; they own the result.
juce::AudioProcessor* JUCE_CALLTYPE createPluginFilter();
juce::AudioProcessor* JUCE_CALLTYPE createPluginFilter()
{
    return new pacini::plugin::Plugin();
}
