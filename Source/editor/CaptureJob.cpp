// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/CaptureJob.h"

#include <pacini/analysis/EncodeSound.h>

#include <cmath>
#include <utility>

namespace pacini::editor
{

Result<Clip> clipOfCapture(const Capture& capture, double sampleRate, const std::string& name)
{
    const int rate = static_cast<int>(std::lround(sampleRate));
    if (rate < 8000 || rate > 768000)
        return Error{ErrorCode::invalidArgument, "sample rate", "must be 8 to 768 kHz to be encoded"};
    if (static_cast<double>(capture.samples.size()) < 0.1 * sampleRate)
        return Error{ErrorCode::invalidData, "", "less than 0.1 s of sound was captured"};
    Encoder encoder{EncoderParams{}};
    auto clip = encodeSound(encoder, {rate, 1}, SoundParts(capture.samples, 1));
    if (clip)
        clip->name = name;
    return clip;
}

CaptureJob::~CaptureJob()
{
    cancelPendingUpdate();
    stopThread(-1);
}

bool CaptureJob::begin(Capture capture, double sampleRate, const juce::String& name,
                       std::function<void(Result<Clip>)> done)
{
    if (busy)
        return false;
    stopThread(-1);
    busy = true;
    samples = std::move(capture);
    fs = sampleRate;
    clipName = name.toStdString();
    finished = std::move(done);
    startThread();
    return true;
}

void CaptureJob::run()
{
    result.emplace(clipOfCapture(samples, fs, clipName));
    triggerAsyncUpdate();
}

void CaptureJob::handleAsyncUpdate()
{
    busy = false;
    if (result)
        finished(std::move(*result));
}

} // namespace pacini::editor
