#pragma once

// Player for a controller, on a thread of its own.

#include "devices/ClipRumble.h"
#include "devices/ControllerReports.h"
#include "devices/ReportSink.h"
#include "devices/RumbleSource.h"
#include "devices/SendClock.h"

#include <pacini/foundation/Result.h>
#include <pacini/foundation/Units.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <thread>
#include <utility>

namespace pacini::devices
{

/// Statistics of a playback.
struct PlayReport
{
    std::int64_t sent = 0;    ///< reports
    std::int64_t leftOut = 0; ///< packets that would have come too late
    Seconds latest;           ///< by how much the packet that was latest came too late
};

/// Packet n is sent n intervals after the first; a late one moves no other. When sending takes longer than an interval,
/// the packets that it has taken the place of are left out. What a controller plays from a memory of its own is sent
/// Pacing::ahead intervals before, and only left out when the memory has run dry. Whatever ends playing, the last two
/// packets are silent; after them come only the closing reports of the controller.
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
    [[nodiscard]] Seconds position() const noexcept { return Seconds(played.load(std::memory_order_relaxed)); }

    /// Silences the controller at once, whatever is still to be played, and returns when that is done. [message]
    void stop();

    /// Returns when all is played. Errors: those of the sink. [message]
    Result<PlayReport> finish();

private:
    void run();
    void play();
    [[nodiscard]] bool send(const Report& report);
    [[nodiscard]] bool sendAll(std::span<const TimedReport> reports);

    const ControllerModel model;
    const Pacing pacing;
    std::unique_ptr<RumbleSource> source;
    ReportSink& sink;
    SendClock& clock;
    std::atomic<bool> playing{true};
    std::atomic<double> played{0.0}; ///< s
    // Of the thread until it has ended.
    unsigned counter = 0;
    PlayReport report;
    Result<void> failure;
    std::thread thread;
};

} // namespace pacini::devices
