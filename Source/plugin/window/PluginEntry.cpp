// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/window/PluginEntry.h"

#include "plugin/window/Plugin.h"

namespace pacini::plugin
{

namespace
{
thread_local PluginProcessor* newest = nullptr;
}

PluginProcessor* newestPlugin() noexcept
{
    return newest;
}

} // namespace pacini::plugin

/// What JUCE's wrappers call; they own the result.
juce::AudioProcessor* JUCE_CALLTYPE createPluginFilter();
juce::AudioProcessor* JUCE_CALLTYPE createPluginFilter()
{
    return pacini::plugin::newest = new pacini::plugin::Plugin();
}
