// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Choice of the audio device, its rate, buffer and channels, in the look of the other controls.

#include "editor/List.h"
#include "editor/Theme.h"

#include <juce_audio_utils/juce_audio_utils.h>

#include <functional>
#include <memory>
#include <vector>

namespace pacini::editor
{

/// Channels of a device, each ticked when it is in use. A click or the space bar changes one.
class ChannelList final : public juce::Component, private juce::ListBoxModel
{
public:
    explicit ChannelList(const juce::String& name);
    ~ChannelList() override;

    std::function<void(const juce::BigInteger&)> onChange; ///< the channels that are wanted
    void show(const juce::StringArray& names, const juce::BigInteger& used);

    void resized() override { list.setBounds(getLocalBounds().reduced(0, grid / 2)); }
    void paint(juce::Graphics& g) override;
    void paintOverChildren(juce::Graphics& g) override;
    int getNumRows() override { return channels.size(); }
    juce::String getNameForRow(int row) override;

private:
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool selected) override;
    void listBoxItemClicked(int row, const juce::MouseEvent& event) override;
    bool keyPressed(const juce::KeyPress& key) override;
    void turn(int row);

    juce::StringArray channels;
    juce::BigInteger inUse;
    List list{{}, this};
};

/// Every change is taken at once; what a device refuses is said below. [message]
class DeviceSettings final : public juce::Component, private juce::ChangeListener
{
public:
    explicit DeviceSettings(juce::AudioDeviceManager& wanted);
    ~DeviceSettings() override;

    void resized() override;

private:
    using Setup = juce::AudioDeviceManager::AudioDeviceSetup;

    void changeListenerCallback(juce::ChangeBroadcaster*) override { fill(); }
    void fill();
    void change(const std::function<void(Setup&)>& edit);
    [[nodiscard]] juce::AudioIODeviceType* kind() const;

    struct Row
    {
        juce::Label name;
        juce::ComboBox box;
    };
    void prepare(Row& row, const juce::String& name, const juce::String& help);

    juce::AudioDeviceManager& manager;
    Row type, output, input, rate, buffer;
    juce::TextButton testButton;
    juce::Label outputsLabel, inputsLabel, note;
    ChannelList outputs{"Output channels"}, inputs{"Input channels"};
};

} // namespace pacini::editor
