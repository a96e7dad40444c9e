// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Routing bar above the plugin's window: menus of the inputs, the sound's output and the haptic output.

#include "app/AudioDevices.h"
#include "editor/Theme.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>
#include <memory>

namespace pacini::app
{

/// While no device is open, a line that says so and what to do stands in the place of the menus.
class RoutingBar final : public juce::Component, private juce::ChangeListener
{
public:
    explicit RoutingBar(AudioDevices& wanted);
    ~RoutingBar() override;

    void paint(juce::Graphics& g) override;
    void resized() override;
    void lookAndFeelChanged() override;

    std::function<void()> onDevices; ///< the button for the sound devices was pressed

private:
    void changeListenerCallback(juce::ChangeBroadcaster*) override { fillMenus(); }
    void fillMenus();
    void showMissing(bool isMissing);
    void readMenus();
    void fillHapticMenu(const Routing& now, const juce::StringArray& outputs);
    void readHapticMenu(Routing& wanted) const;
    void chooseFile();

    AudioDevices& rig;
    juce::TextButton devicesButton, fileButton;
    juce::ComboBox input, sidechain, heard, haptic;
    juce::Label inputLabel, sidechainLabel, heardLabel, hapticLabel;
    juce::Label missing;
    std::unique_ptr<juce::FileChooser> chooser;
};

} // namespace pacini::app
