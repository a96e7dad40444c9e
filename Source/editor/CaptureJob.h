// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Background encoding of captured sound to a clip, with the sound where it is kept.

#include "document/AudioReference.h"

#include <pacini/analysis/EncoderParams.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>
#include <pacini/realtime/CaptureRing.h>

#include <juce_core/juce_core.h>
#include <juce_events/juce_events.h>

#include <functional>
#include <optional>
#include <string>

namespace pacini::editor
{

/// The clip of a capture, on the grids of its quantiser and sealed. Errors: invalidData for less than a tenth of a
/// second, invalidArgument for rates that the encoder does not know (8 to 768 kHz).
[[nodiscard]] Result<Clip> clipOfCapture(const Capture& capture, double sampleRate, const std::string& name,
                                         const EncoderParams& params = {});

/// The sound of a capture as an embedded FLAC file of 24 bits, or of floats as a WAV where it is beyond full scale.
/// Errors: those of AudioWriter and describeAudio().
[[nodiscard]] Result<DescribedAudio> soundOfCapture(const Capture& capture, double sampleRate, const std::string& name);

/// Result of a capture.
struct CapturedClip
{
    Clip clip;
    std::optional<Result<DescribedAudio>> sound; ///< where it was to be kept
    EncoderParams encoder = {};                  ///< of the clip
};

/// Encodes one capture on its own thread.
class CaptureJob final : private juce::Thread, private juce::AsyncUpdater
{
public:
    CaptureJob() : juce::Thread("Pacini capture") {}
    ~CaptureJob() override;

    struct Wanted
    {
        Capture capture;
        double sampleRate = 0.0;
        std::string name;
        bool keepSound = false;
        EncoderParams encoder = {};
    };
    /// `done` is called on the message thread. While a job runs nothing is begun and false returned. [message]
    bool begin(Wanted wanted, std::function<void(Result<CapturedClip>)> done);

private:
    void run() override;
    void handleAsyncUpdate() override;

    Wanted now;
    std::function<void(Result<CapturedClip>)> finished;
    std::optional<Result<CapturedClip>> result;
    bool busy = false;
};

} // namespace pacini::editor
