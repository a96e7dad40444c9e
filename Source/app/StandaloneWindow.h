// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Window of the standalone program: the plugin's window with the routing bar above it.

#include "app/AudioDevices.h"
#include "app/RoutingBar.h"
#include "plugin/window/PluginWindow.h"

#include <juce_audio_utils/juce_audio_utils.h>

#include <memory>

namespace pacini::app
{

class StandaloneWindow final : public juce::DocumentWindow
{
public:
    StandaloneWindow(plugin::Plugin& processor, AudioDevices& rig);
    ~StandaloneWindow() override;

    void closeButtonPressed() override;
    bool keyPressed(const juce::KeyPress& key) override;

private:
    class Content;
};

} // namespace pacini::app
