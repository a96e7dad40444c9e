// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Background encoding of captured sound to a clip.

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>
#include <pacini/realtime/CaptureRing.h>

#include <juce_core/juce_core.h>
#include <juce_events/juce_events.h>

#include <functional>
#include <optional>

namespace pacini::editor
{

/// The clip of a capture, with the encoder's usual parameters, on the grids of its quantiser. Errors: invalidData for
/// less than a tenth of a second, invalidArgument for rates that the encoder does not know (8 to 768 kHz).
[[nodiscard]] Result<Clip> clipOfCapture(const Capture& capture, double sampleRate, const std::string& name);

/// Encodes one capture on a thread of its own.
class CaptureJob final : private juce::Thread, private juce::AsyncUpdater
{
public:
    CaptureJob() : juce::Thread("Pacini capture") {}
    ~CaptureJob() override;

    /// `done` is called on the message thread. While a job runs nothing is begun and false returned. [message]
    bool begin(Capture capture, double sampleRate, const juce::String& name, std::function<void(Result<Clip>)> done);

private:
    void run() override;
    void handleAsyncUpdate() override;

    Capture samples;
    double fs = 0.0;
    std::string clipName;
    std::function<void(Result<Clip>)> finished;
    std::optional<Result<Clip>> result;
    bool busy = false;
};

} // namespace pacini::editor
