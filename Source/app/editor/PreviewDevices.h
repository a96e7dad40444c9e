// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sound device of the editor: sound and drive signals on channels of their own.

#include "document/ClipPlayer.h"
#include "editor/clip/session/HapticOutputs.h"
#include "editor/clip/session/OutputTrim.h"

#include <juce_audio_devices/juce_audio_devices.h>

#include <array>
#include <atomic>

namespace pacini::app
{

class PreviewDevices final : private juce::AudioIODeviceCallback, private juce::AsyncUpdater
{
public:
    PreviewDevices(ClipPlayer& wanted, const editor::HapticOutputs& hapticOutputs);
    ~PreviewDevices() override;

    /// Opens a device; an error text, empty when all is well. [message]
    juce::String open(const juce::XmlElement* saved, const juce::String& deviceType);
    [[nodiscard]] juce::AudioDeviceManager& devices() noexcept { return manager; }
    [[nodiscard]] juce::StringArray outputNames() const;

    /// The first of two channels where the sound is heard, from 0; -1: none.
    [[nodiscard]] int soundOutput() const noexcept { return soundChannel.load(std::memory_order_relaxed); }
    void setSoundOutput(int first) noexcept { soundChannel.store(first, std::memory_order_relaxed); }

    [[nodiscard]] editor::OutputTrim& soundTrim() noexcept { return soundLevel; }

private:
    static constexpr int pieceFrames = 1024;
    static constexpr int maxChannels = 256;

    void audioDeviceAboutToStart(juce::AudioIODevice* device) override;
    void audioDeviceStopped() override { running.store(false); }
    void audioDeviceIOCallbackWithContext(const float* const* in, int ins, float* const* out, int outs, int frames,
                                          const juce::AudioIODeviceCallbackContext& context) override;
    void handleAsyncUpdate() override;
    void follow();

    static constexpr std::size_t mostHaptic = editor::HapticOutputs::most;

    ClipPlayer& player;
    const editor::HapticOutputs& haptic;
    juce::AudioDeviceManager manager;
    std::atomic<int> soundChannel{0};
    std::array<std::atomic<int>, mostHaptic> hapticChannels{}; ///< of each output; -1: none
    editor::OutputTrim soundLevel;
    std::array<editor::OutputTrim, mostHaptic> hapticLevels;
    std::atomic<double> rate{48000.0};
    std::atomic<bool> running{false}; ///< the player knows the device's rate
    std::atomic<bool> inside{false};  ///< the callback uses the player
    juce::AudioBuffer<float> buffer{2 + static_cast<int>(mostHaptic), pieceFrames};
    editor::Subscriptions subscriptions;
};

} // namespace pacini::app
