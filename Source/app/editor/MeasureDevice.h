// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Measurement rig on the editor's sound device: plays the sweep and records the sensor.

#include "document/measure/MeasureCallback.h"
#include "document/measure/MeasureRig.h"
#include "editor/clip/session/HapticOutputs.h"

#include <juce_audio_devices/juce_audio_devices.h>

#include <array>
#include <atomic>

namespace pacini::app
{

/// Plays on one output and records up to three inputs of the device that the editor has open, in its callback. The
/// inputs are opened only for measuring, as some systems show that a program records.
class MeasureDevice final : public MeasureRig, private juce::AudioIODeviceCallback
{
public:
    /// `wanted` and `hapticOutputs` outlive this. The actuator is expected on the first of `hapticOutputs`; null:
    /// unknown.
    explicit MeasureDevice(juce::AudioDeviceManager& wanted, const editor::HapticOutputs* hapticOutputs = nullptr);
    ~MeasureDevice() override;

    void setOpen(bool open) override;
    [[nodiscard]] RigPorts ports() override;
    void wire(const RigWiring& wiring) override;
    Result<void> start(std::vector<float> signal) override;
    void stop() override;
    [[nodiscard]] RigState state() const override;
    [[nodiscard]] double progress() const override { return callback.sweeps().progress(); }
    [[nodiscard]] std::vector<std::vector<float>> takeRecording() override;
    [[nodiscard]] float takePeak(std::size_t input) override { return callback.sweeps().takePeak(input); }
    void setTone(std::optional<double> level) override { callback.setTone(level); }

private:
    static constexpr std::size_t maxInputs = PlayAndRecord::maxChannels;

    void audioDeviceAboutToStart(juce::AudioIODevice* device) override;
    void audioDeviceStopped() override { interrupted.store(true); }
    void audioDeviceIOCallbackWithContext(const float* const* in, int ins, float* const* out, int outs, int frames,
                                          const juce::AudioIODeviceCallbackContext& context) override;

    juce::AudioDeviceManager& manager;
    const editor::HapticOutputs* haptic;
    juce::AudioDeviceManager::AudioDeviceSetup before; ///< of the device, to be put back
    bool opened = false;
    bool running = false; ///< a sweep has been started and not taken
    juce::String openingError;
    MeasureCallback callback;
    std::atomic<int> output{0};
    std::atomic<int> secondOutput{-1};                ///< -1: none
    std::array<std::atomic<int>, maxInputs> inputs{}; ///< -1: none
    std::atomic<bool> interrupted{false};
};

} // namespace pacini::app
