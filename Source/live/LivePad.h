#pragma once

// A controller that plays a live drive signal, and comes back after it was unplugged.

#include "devices/HidList.h"
#include "devices/RumblePlayer.h"
#include "devices/SteadyClock.h"
#include "live/LatencyProbe.h"
#include "live/LiveDrive.h"
#include "live/OpenedController.h"

#include <pacini/foundation/Result.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace pacini::live
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

/// Which controller, and how it is opened; each asked for anew until it is there. [worker]
struct PadDoor
{
    std::function<Result<devices::Controller>()> find; ///< the error says why there is none
    std::function<Result<OpenedController>(const devices::Controller&)> open;
    bool stopsOnCrash = true; ///< see devices::EmergencyStop, which takes signals of the whole program
};

/// What LivePad::look() noticed.
struct PadNews
{
    bool isBack = false;           ///< it plays again
    std::string lesser;            ///< why it plays by rumble, told once for each connection
    std::optional<Error> stopped;  ///< why it does not play any more until it is back
    std::optional<Error> notFound; ///< why it is not connected, each time it was tried
};

/// Sends from its own thread; all functions are for one other thread.
class LivePad
{
public:
    /// The drive and the probe, which may be null, outlive this.
    LivePad(PadDoor wanted, LiveDrive& drive, double sampleRate, LatencyProbe* probe);
    LivePad(const LivePad&) = delete;
    LivePad& operator=(const LivePad&) = delete;
    ~LivePad();

    /// Opens the controller and starts. Errors: those of the door; invalidArgument for a rate that it does not take.
    /// [message]
    [[nodiscard]] Result<void> open();

    /// Notices that it was unplugged, and looks for it now and then until it is back. [message]
    [[nodiscard]] PadNews look();

    /// Whether it is open and has taken something. [message]
    [[nodiscard]] bool isConnected() const noexcept;

    /// Its name, once it was connected. [message]
    [[nodiscard]] const std::string& name() const noexcept { return report.name; }

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

    PadDoor door;
    LiveDrive& source;
    double fs;
    LatencyProbe* measured;
    std::unique_ptr<Link> link; ///< none: not connected
    std::chrono::steady_clock::time_point lastLook;
    LivePadReport report;
};

} // namespace pacini::live
