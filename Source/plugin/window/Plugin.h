// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The plugin as hosts see it: the processor with its window.

#include "plugin/engine/PluginProcessor.h"
#include "plugin/window/HostedSession.h"
#include "plugin/window/WindowSettings.h"

namespace pacini::plugin
{

class Plugin final : public PluginProcessor
{
public:
    Plugin() = default;

    juce::AudioProcessorEditor* createEditor() override;
    bool hasEditor() const override { return true; }

    /// The folder of the user's presets and the settings of all windows. [message]
    [[nodiscard]] const juce::File& userFolder() const noexcept { return folder; }
    /// Before a window is made.
    void setUserFolder(const juce::File& wanted) { folder = wanted; }

    /// The clips that are edited in the window; they stay open when it is closed.
    [[nodiscard]] HostedSession& clips() noexcept { return hostedSession; }

private:
    juce::File folder = usualUserFolder();
    HostedSession hostedSession{project()};

    JUCE_DECLARE_NON_COPYABLE_WITH_LEAK_DETECTOR(Plugin)
};

} // namespace pacini::plugin
