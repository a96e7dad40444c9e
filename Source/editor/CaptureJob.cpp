// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/CaptureJob.h"

#include "editor/Text.h"
#include "io/AudioWriter.h"
#include "io/FinishedClip.h"

#include <pacini/analysis/EncodeSound.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini::editor
{

Result<Clip> clipOfCapture(const Capture& capture, double sampleRate, const std::string& name,
                           const EncoderParams& params)
{
    const int rate = static_cast<int>(std::lround(sampleRate));
    if (rate < 8000 || rate > 768000)
        return Error{ErrorCode::invalidArgument, "sample rate", "must be 8 to 768 kHz to be encoded"};
    if (static_cast<double>(capture.samples.size()) < 0.1 * sampleRate)
        return Error{ErrorCode::invalidData, "", "less than 0.1 s of sound was captured"};
    Encoder encoder{params};
    auto clip = encodeSound(encoder, {rate, 1}, SoundParts(capture.samples, 1));
    return clip ? finishClip(std::move(*clip), {name, ""}) : clip;
}

Result<DescribedAudio> soundOfCapture(const Capture& capture, double sampleRate, const std::string& name)
{
    const bool beyond = std::any_of(capture.samples.begin(), capture.samples.end(),
                                    [](float sample) { return !(std::abs(sample) < 1.0f); });
    const juce::TemporaryFile file(beyond ? ".wav" : ".flac");
    const auto path = pathOf(file.getFile());
    AudioWriteParams params;
    params.sampleRate = static_cast<int>(std::lround(sampleRate));
    params.encoding = beyond ? SampleEncoding::float32 : SampleEncoding::pcm24;
    params.expectedFrames = capture.samples.size();
    if (const auto written = writeAudio(path, capture.samples, params); !written)
        return written.error();
    auto sound = describeAudio(path, true);
    if (sound)
        sound->reference.path = name + path.extension().string();
    return sound;
}

CaptureJob::~CaptureJob()
{
    cancelPendingUpdate();
    stopThread(-1);
}

bool CaptureJob::begin(Wanted wanted, std::function<void(Result<CapturedClip>)> done)
{
    if (busy)
        return false;
    stopThread(-1);
    busy = true;
    now = std::move(wanted);
    finished = std::move(done);
    startThread();
    return true;
}

void CaptureJob::run()
{
    auto clip = clipOfCapture(now.capture, now.sampleRate, now.name, now.encoder);
    if (!clip)
        result.emplace(clip.error());
    else
    {
        CapturedClip captured{std::move(clip).value(), {}, now.encoder};
        if (now.keepSound)
            captured.sound = soundOfCapture(now.capture, now.sampleRate, now.name);
        result.emplace(std::move(captured));
    }
    triggerAsyncUpdate();
}

void CaptureJob::handleAsyncUpdate()
{
    busy = false;
    if (result)
        finished(std::move(*result));
}

} // namespace pacini::editor
