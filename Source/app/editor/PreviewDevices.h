// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sound device of the editor: sound and drive signal on channels of their own.

#include "document/ClipPlayer.h"
#include "editor/clip/session/OutputTrim.h"

#include <juce_audio_devices/juce_audio_devices.h>

#include <array>
#include <atomic>

namespace pacini::app
{

/// Output channels, numbered from 0; -1 is none.
struct PreviewOutputs
{
    int sound = 0;  ///< the first of two
    int haptic = 2; ///< on devices with fewer channels the last one
    bool operator==(const PreviewOutputs&) const = default;
};

class PreviewDevices final : private juce::AudioIODeviceCallback, private juce::AsyncUpdater
{
public:
    explicit PreviewDevices(ClipPlayer& wanted);
    ~PreviewDevices() override;

    /// Opens a device; an error text, empty when all is well. [message]
    juce::String open(const juce::XmlElement* saved, const juce::String& deviceType);
    [[nodiscard]] juce::AudioDeviceManager& devices() noexcept { return manager; }
    [[nodiscard]] juce::StringArray outputNames() const;

    [[nodiscard]] PreviewOutputs outputs() const noexcept
    {
        return {soundOutput.load(std::memory_order_relaxed), hapticOutput.load(std::memory_order_relaxed)};
    }
    void setOutputs(PreviewOutputs wanted) noexcept;

    [[nodiscard]] editor::OutputTrim& soundTrim() noexcept { return soundLevel; }
    [[nodiscard]] editor::OutputTrim& hapticTrim() noexcept { return hapticLevel; }

private:
    static constexpr int pieceFrames = 1024;
    static constexpr int maxChannels = 256;

    void audioDeviceAboutToStart(juce::AudioIODevice* device) override;
    void audioDeviceStopped() override { running.store(false); }
    void audioDeviceIOCallbackWithContext(const float* const* in, int ins, float* const* out, int outs, int frames,
                                          const juce::AudioIODeviceCallbackContext& context) override;
    void handleAsyncUpdate() override;

    ClipPlayer& player;
    juce::AudioDeviceManager manager;
    std::atomic<int> soundOutput{0}, hapticOutput{2};
    editor::OutputTrim soundLevel, hapticLevel;
    std::atomic<double> rate{48000.0};
    std::atomic<bool> running{false}; ///< the player knows the device's rate
    std::atomic<bool> inside{false};  ///< the callback uses the player
    juce::AudioBuffer<float> buffer{3, pieceFrames};
};

} // namespace pacini::app
