// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Toolbar: transport, zoom, actuator and clip, always in sight.

#include "editor/Controls.h"
#include "editor/Icons.h"
#include "editor/clip/commands/Command.h"
#include "editor/clip/session/Transport.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>

namespace pacini::editor
{

class Toolbar final : public juce::Component, private juce::Timer
{
public:
    Toolbar(EditorModel& project, Actuators& profiles, Transport& playing);

    std::function<void(Command)> onCommand;

    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void timerCallback() override { showTime(); }
    void showTime();
    void fillClips();
    void fillProfiles();
    void showState();

    EditorModel& model;
    Actuators& actuators;
    Transport& transport;
    IconButton startButton{Icon::toStart}, playButton{Icon::play}, loopButton{Icon::loop};
    IconButton zoomOutButton{Icon::zoomOut}, zoomInButton{Icon::zoomIn}, fitButton{Icon::fit};
    juce::Label time, clipLabel, heardLabel, profileLabel, strengthLabel;
    juce::ComboBox clips, heard, profile;
    Slider strength;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
