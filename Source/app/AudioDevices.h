// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Routing of the standalone program's sound device: the plugin's inputs, the sound's output, and the channels of the
// actuators.

#include "app/LoadedSound.h"
#include "app/TestSignal.h"
#include "plugin/engine/PluginProcessor.h"

#include <pacini/foundation/HandOver.h>

#include <juce_audio_devices/juce_audio_devices.h>

#include <array>
#include <atomic>
#include <memory>
#include <vector>

namespace pacini::app
{

enum class InputChoice
{
    device, ///< inputs of the interface
    test,   ///< the test signal
    file    ///< the loaded file, again and again
};

/// Input and channels of each signal, numbered from 0; -1 is none.
struct Routing
{
    InputChoice input = InputChoice::device;
    int mainInput = 0; ///< the first of two
    int sidechainInput = 2;
    int mainOutput = 0;     ///< the first of two, where the sound is heard
    int hapticChannels = 1; ///< of the plugin, 1 to 8
    std::array<int, plugin::maxHapticChannels> hapticOutputs{2, -1, -1, -1, -1, -1, -1, -1}; ///< of each
    bool operator==(const Routing&) const = default;
};

/// Runs the plugin's processor in the callback of a sound device.
class AudioDevices final : private juce::AudioIODeviceCallback
{
public:
    explicit AudioDevices(plugin::PluginProcessor& wanted);
    ~AudioDevices() override;

    /// Opens a device with as many channels as it has; an error text, empty when all is well. [message]
    juce::String open(const juce::XmlElement* saved, const juce::String& deviceType);

    [[nodiscard]] juce::AudioDeviceManager& devices() noexcept { return manager; }
    /// Channels of the open device. [message]
    [[nodiscard]] juce::StringArray inputNames() const;
    [[nodiscard]] juce::StringArray outputNames() const;

    [[nodiscard]] Routing routing() const noexcept;
    /// Sound stops for a moment where the number of haptic channels is another one. [message]
    void setRouting(const Routing& wanted);

    /// Loads a file and plays it from its beginning. [message]
    Result<void> play(const juce::File& file);

private:
    using Sounds = HandOver<LoadedSound>;

    static constexpr int pieceFrames = 512;
    static constexpr int maxChannels = 256;

    void audioDeviceAboutToStart(juce::AudioIODevice* device) override;
    void audioDeviceStopped() override;
    void audioDeviceIOCallbackWithContext(const float* const* in, int ins, float* const* out, int outs, int frames,
                                          const juce::AudioIODeviceCallbackContext& context) override;
    void fillInputs(const Routing& now, const float* const* in, int ins, int done, int frames) noexcept;
    void takeSound() noexcept;
    void setHapticChannels(int count);

    plugin::PluginProcessor& processor;
    juce::AudioDeviceManager manager;

    std::atomic<InputChoice> input{InputChoice::device};
    std::atomic<int> mainInput{0}, sidechainInput{2}, mainOutput{0};
    std::array<std::atomic<int>, plugin::maxHapticChannels> hapticOutputs{2, -1, -1, -1, -1, -1, -1, -1};
    int hapticChannels = 1; ///< never changed while the callback may run
    bool running = false;   ///< the callback may run

    juce::File file;
    std::unique_ptr<Sounds> sounds = std::make_unique<Sounds>();
    std::unique_ptr<Sounds::Node> sound; // the audio thread's
    std::size_t position = 0;
    TestSignal test;
    juce::AudioBuffer<float> buffer{2 + static_cast<int>(plugin::maxHapticChannels), pieceFrames};
    juce::MidiBuffer midi;
    /// Index of each device channel among the enabled channels; -1 if it is disabled.
    std::array<int, maxChannels> inputPlaces{}, outputPlaces{};
};

} // namespace pacini::app
