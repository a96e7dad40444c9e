// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the window of something that runs live reads from it.

#include <pacini/foundation/Result.h>
#include <pacini/realtime/CaptureRing.h>
#include <pacini/realtime/TranslatorMeters.h>

#include <juce_core/juce_core.h>

namespace pacini::editor
{

/// Everything is called on the message thread and answers without waiting for the audio thread.
class LiveSource
{
public:
    virtual ~LiveSource() = default;

    [[nodiscard]] virtual TranslatorMeterReading readMeters() const = 0;
    /// The largest sample of the source since the last call, linear.
    [[nodiscard]] virtual float takeInputPeak() = 0;
    [[nodiscard]] virtual double sampleRate() const = 0;
    /// Frames by which the haptic signal is later than the sound.
    [[nodiscard]] virtual int latency() const = 0;

    /// The newest of the source, mono, all finite.
    [[nodiscard]] virtual Capture capture(double seconds) const = 0;
    [[nodiscard]] virtual double captureLength() const = 0; ///< s, the longest capture

    /// The name of the actuator that the signal is made for now.
    [[nodiscard]] virtual juce::String actuatorName() const = 0;
    /// Takes an actuator from a profile file.
    virtual Result<void> loadActuator(const juce::File& file) = 0;

    /// What a session brought that could not be used; empty: nothing.
    [[nodiscard]] virtual juce::String note() const = 0;
};

} // namespace pacini::editor
