// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tap input from MIDI pads and game controllers: events at the playhead during playback.

#include "app/editor/JoystickReader.h"
#include "editor/clip/session/Tapping.h"

#include <juce_audio_devices/juce_audio_devices.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

namespace pacini::app
{

/// Notes of all MIDI inputs, and buttons of the joysticks that Linux lists, become taps while a clip plays and the
/// program is in front. A note's velocity is the event's level. Devices may come and go.
class TapInput final : private juce::MidiInputCallback, private juce::AsyncUpdater, private juce::Timer
{
public:
    /// `folder`: that has the joysticks, as `js0`. [message]
    TapInput(editor::Tapping& wanted, const editor::Transport& playing, std::filesystem::path folder = "/dev/input");
    ~TapInput() override;

    /// For tests: taps also while another program is in front.
    std::atomic<bool> inBackground{false};

    /// A tap with a level of 0 to 1, heard when the message thread is next free. [any]
    void tap(double level);

private:
    void handleIncomingMidiMessage(juce::MidiInput* source, const juce::MidiMessage& message) override;
    void handleAsyncUpdate() override;
    void timerCallback() override;

    editor::Tapping& tapping;
    const editor::Transport& transport;
    std::mutex mutex; ///< guards waiting items
    std::vector<double> waiting;
    std::vector<std::unique_ptr<juce::MidiInput>> inputs;
    std::unique_ptr<JoystickReader> joysticks;
};

} // namespace pacini::app
