// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sound device of the editor: sound and drive signals on channels of their own; a device that goes away and comes back.

#include "app/ChannelPlaces.h"
#include "document/ClipPlayer.h"
#include "editor/clip/session/HapticOutputs.h"
#include "editor/clip/session/OutputTrim.h"

#include <juce_audio_devices/juce_audio_devices.h>

#include <array>
#include <atomic>
#include <functional>
#include <memory>

namespace pacini::app
{

/// Runs the player in the device's callback, or without a device on the message thread, so that controllers and phones
/// can follow it. Reports the available channels to the haptic outputs. Searches for a lost device and opens it again
/// when it returns.
class PreviewDevices final : private juce::AudioIODeviceCallback,
                             private juce::AsyncUpdater,
                             private juce::ChangeListener,
                             private juce::Timer
{
public:
    PreviewDevices(ClipPlayer& wanted, editor::HapticOutputs& hapticOutputs);
    ~PreviewDevices() override;

    std::function<void()> onLost;  ///< the device has gone, or the user has chosen none
    std::function<void()> onFound; ///< the device has returned, or another one was opened
    [[nodiscard]] bool isLookingForDevice() const noexcept { return !there && !chosenNone; }

    /// Opens a device; an error text, empty when all is well. [message]
    juce::String open(const juce::XmlElement* saved, const juce::String& deviceType);
    /// Looks for the device that was lost, or for any, and opens it; whether there is one now. [message]
    bool reconnect();
    [[nodiscard]] juce::AudioDeviceManager& devices() noexcept { return manager; }
    [[nodiscard]] juce::StringArray outputNames() const;
    [[nodiscard]] const editor::HapticOutputs& hapticOutputs() const noexcept { return haptic; }

    /// The first of two channels where the sound is heard, from 0; -1: none.
    [[nodiscard]] int soundOutput() const noexcept { return soundChannel; }
    void setSoundOutput(int first);

    [[nodiscard]] editor::OutputTrim& soundTrim() noexcept { return soundLevel; }

private:
    static constexpr int pieceFrames = 1024;

    void audioDeviceAboutToStart(juce::AudioIODevice* device) override;
    void audioDeviceStopped() override { running.store(false); }
    void audioDeviceIOCallbackWithContext(const float* const* in, int ins, float* const* out, int outs, int frames,
                                          const juce::AudioIODeviceCallbackContext& context) override;
    void handleAsyncUpdate() override;
    void changeListenerCallback(juce::ChangeBroadcaster*) override { look(); }
    void timerCallback() override;
    void follow();
    void look();
    [[nodiscard]] bool isAlive() const;
    [[nodiscard]] bool userChoseNone() const;
    bool openLost();
    void playSilently();

    static constexpr std::size_t mostHaptic = editor::HapticOutputs::most;

    ClipPlayer& player;
    editor::HapticOutputs& haptic;
    juce::AudioDeviceManager manager;
    std::array<std::atomic<int>, 2> soundPlaces{};           ///< in the callback; -1: none
    std::array<std::atomic<int>, mostHaptic> hapticPlaces{}; ///< the same of each output
    editor::OutputTrim soundLevel;
    std::array<editor::OutputTrim, mostHaptic> hapticLevels;
    std::atomic<double> rate{48000.0};
    std::atomic<bool> running{false};      ///< the player knows the device's rate
    std::atomic<bool> inside{false};       ///< the callback uses the player
    std::atomic<juce::uint32> lastCall{0}; ///< ms, of the callback
    juce::AudioBuffer<float> buffer{2 + static_cast<int>(mostHaptic), pieceFrames};

    // Of the message thread.
    int soundChannel = 0;
    bool begun = false;                                   ///< open() was called
    bool there = false;                                   ///< the device runs
    bool chosenNone = false;                              ///< by the user: nothing is looked for
    juce::AudioDeviceManager::AudioDeviceSetup lastSetup; ///< of the device that ran
    juce::String lastType;
    std::unique_ptr<juce::XmlElement> savedState; ///< passed to open()
    juce::String wantedType;
    juce::uint32 lastSearch = 0, searchInterval = 0, lastSilence = 0; ///< ms
    editor::Subscriptions subscriptions;
};

} // namespace pacini::app
