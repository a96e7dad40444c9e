// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is heard and felt of the clip that is edited, whatever the rate of the device.

#include "document/PreviewEngine.h"
#include "document/PreviewWorker.h"
#include "editor/clip/session/Jobs.h"
#include "editor/clip/session/Sound.h"

#include <memory>
#include <optional>
#include <span>

namespace pacini::editor
{

/// A preview engine with its worker, made anew when the device changes its rate.
class Player
{
public:
    Player() { prepare(48000.0); }

    /// To be called while process() is not, and on the thread that calls everything else here. Stops playing.
    void prepare(double sampleRate);

    /// See PreviewEngine::process(). [audio]
    void process(std::span<float> haptic, std::span<const std::span<float>> soundOut) noexcept
    {
        engine->process(haptic, soundOut);
    }

    void set(Playback playback);
    void setProfile(std::shared_ptr<const Profile> profile);
    /// The sound beside the clip; null: none. It is heard when it has been resampled.
    void setSound(std::shared_ptr<const Sound> sound);

    void play(double time);
    void stop() { engine->stop(); }
    [[nodiscard]] bool isPlaying() const noexcept { return engine->isPlaying(); }
    [[nodiscard]] double position() const noexcept { return engine->position(); }     ///< s of the clip
    [[nodiscard]] PreviewEngine::Meters takeMeters() { return engine->takeMeters(); } ///< since the last call
    [[nodiscard]] std::optional<Error> lastError() const { return worker->lastError(); }

private:
    void resample();

    double rate = 0.0;
    Playback playback;
    std::shared_ptr<const Profile> profile;
    std::shared_ptr<const Sound> sound;
    std::unique_ptr<PreviewEngine> engine;
    std::unique_ptr<PreviewWorker> worker; // ends before the engine
    Jobs jobs;
};

} // namespace pacini::editor
