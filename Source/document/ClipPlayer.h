#pragma once

// Player of the clip that is edited, at any rate of the device.

#include "document/PreviewEngine.h"
#include "document/PreviewWorker.h"

#include <memory>
#include <optional>
#include <span>

namespace pacini
{

/// A preview engine with its worker, made anew when the device changes its rate.
class ClipPlayer
{
public:
    ClipPlayer() { prepare(48000.0); }

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
    /// The sound beside the clip; null: none.
    void setSound(std::shared_ptr<const StoredAudio> sound);

    void play(double time);
    void stop();
    [[nodiscard]] bool isPlaying() const noexcept { return engine->isPlaying(); }
    [[nodiscard]] double position() const noexcept { return engine->position(); } ///< s of the clip
    /// Of an output, since the last call.
    [[nodiscard]] PreviewEngine::Meters takeMeters(std::size_t output = 0) { return engine->takeMeters(output); }
    [[nodiscard]] std::optional<Error> lastError() const { return worker->lastError(); }

private:
    double rate = 0.0;
    Playback playback;
    PreviewRow row;
    PlayControls controls;
    std::shared_ptr<const StoredAudio> sound;
    std::unique_ptr<PreviewEngine> engine;
    std::unique_ptr<PreviewWorker> worker; // ends before the engine
};

} // namespace pacini
