#pragma once

// Playing on a controller on the calling thread: packet after packet, each at its time.

#include "devices/ControllerReports.h"
#include "devices/ReportSink.h"
#include "devices/RumbleSource.h"
#include "devices/SendClock.h"

#include <pacini/foundation/Result.h>
#include <pacini/foundation/Units.h>

#include <atomic>
#include <cstdint>
#include <span>

namespace pacini::devices
{

/// Statistics of a playback.
struct PlayReport
{
    std::int64_t sent = 0;    ///< reports
    std::int64_t leftOut = 0; ///< packets that would have come too late
    Seconds latest;           ///< by how much the packet that was latest came too late
};

/// Packet n is sent n intervals after the first; a late packet does not delay others. If sending takes longer than an
/// interval, the packets due meanwhile are skipped. Packets for a controller with its own buffer are sent Pacing::ahead
/// intervals early, and are skipped only if the buffer has run empty. Playback always ends with two silent packets,
/// followed only by the closing reports of the controller.
class RumblePlayback
{
public:
    /// All outlive the playback.
    RumblePlayback(const ControllerModel& controller, RumbleSource& whatToPlay, ReportSink& where, SendClock& when)
        : model(controller), pacing(pacingOf(controller)), source(whatToPlay), sink(where), clock(when)
    {
        sink.prepare(stopReports(model));
    }

    /// Returns when all is played, or when the clock was interrupted and the controller is silent. Once. Errors: those
    /// of the sink. [worker]
    Result<PlayReport> run();

    /// How long it has played. [any]
    [[nodiscard]] Seconds position() const noexcept { return Seconds(played.load(std::memory_order_relaxed)); }

private:
    void play();
    [[nodiscard]] bool send(const Report& report);
    [[nodiscard]] bool sendAll(std::span<const TimedReport> reports);

    const ControllerModel model;
    const Pacing pacing;
    RumbleSource& source;
    ReportSink& sink;
    SendClock& clock;
    std::atomic<double> played{0.0}; ///< s
    unsigned counter = 0;
    PlayReport report;
    Result<void> failure;
};

} // namespace pacini::devices
