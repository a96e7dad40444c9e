// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sound device of a study: sound on two channels, touch on another, from the same sample on.

#include "study/StudyRun.h"

#include <juce_audio_devices/juce_audio_devices.h>

#include <array>
#include <atomic>
#include <vector>

namespace pacini::app
{

class StudyDevice final : public study::TrialPlayer, private juce::AudioIODeviceCallback
{
public:
    /// `wanted` outlives this.
    explicit StudyDevice(juce::AudioDeviceManager& wanted);
    ~StudyDevice() override;

    void recover() override;
    [[nodiscard]] int sampleRate() const override;
    void play(study::TrialSound trial) override;
    void stop() override { playback.stop(); }
    [[nodiscard]] study::PlaybackReport report() const override;

    /// Names of the channels that the device carries.
    [[nodiscard]] juce::StringArray outputNames() const;

    /// The first of two channels for the ears, and the first of `actuators` channels for touch; where both are the same
    /// the touch goes there alone.
    void wire(int sound, int touch, int actuators) noexcept;

private:
    static constexpr int pieceFrames = 1024;

    void audioDeviceAboutToStart(juce::AudioIODevice* device) override;
    void audioDeviceStopped() override { playback.drop(); }
    void audioDeviceIOCallbackWithContext(const float* const* in, int ins, float* const* out, int outs, int frames,
                                          const juce::AudioIODeviceCallbackContext& context) override;

    juce::AudioDeviceManager& manager;
    study::TrialPlayback playback;
    std::atomic<int> soundChannel{0}, touchChannel{1}, touchChannels{1};
    // Last observed progress of the playback, for detecting a device that is open but stalled.
    mutable std::size_t lastFrame = 0;
    mutable double lastMoved = 0.0; ///< ms of JUCE's counter
    mutable bool stalled = false;
    std::atomic<juce::AudioIODevice*> device{nullptr};
    int overruns = 0; ///< that the device has counted, of the audio thread
    std::array<std::array<float, pieceFrames>, 2 + study::mostActuators> pieces{};
};

} // namespace pacini::app
