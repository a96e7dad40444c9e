#pragma once

// Player for a controller, on its own thread.

#include "devices/ClipRumble.h"
#include "devices/ControllerReports.h"
#include "devices/ReportSink.h"
#include "devices/RumblePlayback.h"
#include "devices/RumbleSource.h"
#include "devices/SendClock.h"

#include <pacini/foundation/Result.h>
#include <pacini/foundation/Units.h>

#include <atomic>
#include <memory>
#include <thread>
#include <utility>

namespace pacini::devices
{

/// Plays as RumblePlayback does.
class RumblePlayer
{
public:
    /// Starts. `sink` and `clock` outlive the player; `clock` is not shared with another one. [message]
    RumblePlayer(const ControllerModel& controller, std::unique_ptr<RumbleSource> whatToPlay, ReportSink& where,
                 SendClock& when);

    RumblePlayer(const ControllerModel& controller, ClipRumble whatToPlay, ReportSink& where, SendClock& when)
        : RumblePlayer(controller, std::make_unique<ClipRumble>(std::move(whatToPlay)), where, when)
    {
    }

    /// As stop().
    ~RumblePlayer() { stop(); }
    RumblePlayer(const RumblePlayer&) = delete;
    RumblePlayer& operator=(const RumblePlayer&) = delete;

    /// Whether packets are still being sent. [any]
    [[nodiscard]] bool isPlaying() const noexcept { return playing.load(std::memory_order_acquire); }

    /// How long it has played. [any]
    [[nodiscard]] Seconds position() const noexcept { return playback.position(); }

    /// Silences the controller at once, whatever is still to be played, and returns when that is done. [message]
    void stop();

    /// Returns when all is played. Errors: those of the sink. [message]
    Result<PlayReport> finish();

private:
    std::unique_ptr<RumbleSource> source;
    RumblePlayback playback;
    SendClock& clock;
    std::atomic<bool> playing{true};
    Result<PlayReport> result = PlayReport{}; ///< of the thread until it has ended
    std::thread thread;
};

} // namespace pacini::devices
