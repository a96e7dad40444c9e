#pragma once

// Player of the clip that is edited, at any rate of the device.

#include "document/PreviewEngine.h"
#include "document/PreviewWorker.h"

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <thread>

namespace pacini
{

/// A preview engine with its worker, made anew when the device changes its rate.
class ClipPlayer
{
public:
    ClipPlayer() { prepare(48000.0); }
    ~ClipPlayer() { stopResampling(); }

    /// To be called while process() is not, and on the thread that calls everything else here. Stops playing.
    void prepare(double sampleRate);

    /// See PreviewEngine::process(). [audio]
    void process(std::span<const std::span<float>> haptic, std::span<const std::span<float>> soundOut) noexcept
    {
        engine->process(haptic, soundOut);
    }

    void set(Playback playback);
    /// See PreviewEngine::setRow() and setControls().
    void setRow(PreviewRow row);
    void setControls(const PlayControls& controls);
    /// The sound beside the clip; null: none. It is heard when it has been resampled, on a thread of its own.
    void setSound(std::shared_ptr<const AudioData> sound);

    void play(double time);
    void stop();
    [[nodiscard]] bool isPlaying() const noexcept { return engine->isPlaying(); }
    [[nodiscard]] double position() const noexcept { return engine->position(); } ///< s of the clip
    /// Of an output, since the last call.
    [[nodiscard]] PreviewEngine::Meters takeMeters(std::size_t output = 0) { return engine->takeMeters(output); }
    [[nodiscard]] std::optional<Error> lastError() const { return worker->lastError(); }

private:
    void resample();
    void stopResampling();

    double rate = 0.0;
    Playback playback;
    PreviewRow row;
    PlayControls controls;
    std::shared_ptr<const AudioData> sound;
    std::unique_ptr<PreviewEngine> engine;
    std::unique_ptr<PreviewWorker> worker; // ends before the engine
    std::atomic<bool> noLongerWanted{false};
    std::thread resampling; // ends before the worker
};

} // namespace pacini
