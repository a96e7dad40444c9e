#pragma once

// Player of the clip that is edited, at any rate of the device.

#include "document/Playback.h"
#include "document/PreviewRow.h"
#include "io/StoredAudio.h"

#include <pacini/foundation/Result.h>
#include <pacini/runtime/PlayControls.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

namespace pacini
{

class PreviewEngine;
class PreviewWorker;

/// A preview engine with its worker, recreated when the device changes its rate.
class ClipPlayer
{
public:
    ClipPlayer();
    ~ClipPlayer();

    /// To be called while process() is not, and on the thread that calls everything else here. Stops playing.
    void prepare(double sampleRate);

    /// See PreviewEngine::process(). [audio]
    void process(std::span<const std::span<float>> haptic, std::span<const std::span<float>> soundOut) noexcept;

    void set(Playback playback);
    /// See PreviewEngine::setRow() and setControls().
    void setRow(PreviewRow row);
    void setControls(const PlayControls& controls);
    /// The sound beside the clip; null: none.
    void setSound(std::shared_ptr<const StoredAudio> sound);

    void play(double time);
    void stop();
    [[nodiscard]] bool isPlaying() const noexcept;
    [[nodiscard]] double position() const noexcept; ///< s of the clip
    /// Of an output, since the last call.
    [[nodiscard]] PreviewMeters takeMeters(std::size_t output = 0);
    [[nodiscard]] std::optional<Error> lastError() const;

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
