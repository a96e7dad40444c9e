// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Playing, zooming, the actuator and the clip, always in sight.

#include "editor/clip/commands/Command.h"
#include "editor/clip/session/Session.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>

namespace pacini::editor
{

class Toolbar final : public juce::Component, private Session::Listener, private juce::Timer
{
public:
    explicit Toolbar(Session& shared);
    ~Toolbar() override;

    std::function<void(Command)> onCommand;

    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void sessionChanged(unsigned changes) override;
    void timerCallback() override { showTime(); }
    void showTime();
    void fillClips();
    void fillProfiles();
    void showState();

    Session& session;
    juce::TextButton startButton, playButton, zoomOutButton, zoomInButton, fitButton;
    juce::ToggleButton loopButton;
    juce::Label time, clipLabel, heardLabel, profileLabel;
    juce::ComboBox clips, heard, profile;
};

} // namespace pacini::editor
