#pragma once

// A controller that plays a live drive signal, and comes back after it was unplugged.

#include "cli/Console.h"
#include "cli/ControllerInput.h"
#include "cli/live/LatencyProbe.h"
#include "cli/live/LiveDrive.h"
#include "devices/HidList.h"
#include "devices/OpenController.h"
#include "devices/RumblePlayer.h"
#include "devices/SteadyClock.h"

#include <pacini/foundation/Result.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

namespace pacini::cli
{

/// What a controller was sent, all its connections together.
struct LivePadReport
{
    std::string name;
    std::int64_t sent = 0;    ///< reports
    std::int64_t leftOut = 0; ///< packets that would have come too late
    Seconds latest;           ///< by how much the packet that was latest came too late
    int connections = 0;
    std::string lesser; ///< why it plays less than it could; empty otherwise
};

/// Sends from its own thread; all functions are for one other thread.
class LivePad
{
public:
    /// `named` as for --device; the drive and the probe, which may be null, outlive this.
    LivePad(std::string named, DualSenseWay way, LiveDrive& drive, double sampleRate, LatencyProbe* probe);
    LivePad(const LivePad&) = delete;
    LivePad& operator=(const LivePad&) = delete;
    ~LivePad();

    /// Opens the controller and starts. Errors: invalidArgument when several could be meant, io. [message]
    [[nodiscard]] Result<void> open();

    /// Notices that it was unplugged, and looks for it now and then until it is back. [message]
    void look(Console& console);

    /// Whether it was connected and has played all. [message]
    [[nodiscard]] bool isDone() const;

    /// Silences it and tells what it was sent. [message]
    [[nodiscard]] const LivePadReport& close();

private:
    struct Link;

    [[nodiscard]] Result<void> openOne(const devices::Controller& controller);
    [[nodiscard]] Result<void> takeResult();

    /// Counts a connection when it has taken its first report; whether there was one before it.
    bool noteConnection();

    std::string wanted;
    DualSenseWay dualSense;
    LiveDrive& source;
    double fs;
    LatencyProbe* measured;
    std::unique_ptr<Link> link; ///< none: not connected
    std::chrono::steady_clock::time_point lastLook;
    LivePadReport report;
};

} // namespace pacini::cli
