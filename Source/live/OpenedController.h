#pragma once

// A controller that is open to be played on, with its sound device where it plays by that.

#include "devices/ControllerReports.h"
#include "devices/HidList.h"
#include "devices/OpenController.h"
#include "live/SoundPort.h"

#include <pacini/foundation/Result.h>

#include <memory>
#include <string>

namespace pacini::live
{

/// Way in which a DualSense plays.
enum class DualSenseWay
{
    samples,     ///< its sound device on a cable, report 0x32 on Bluetooth
    longSamples, ///< report 0x36 on Bluetooth
    rumble,
};

/// The model with this way, where it has samples at all. [any]
[[nodiscard]] devices::ControllerModel playedIn(devices::ControllerModel model, DualSenseWay way) noexcept;

/// A controller that is open for writing, and what it understands.
struct OpenedController
{
    devices::Controller controller;
    std::unique_ptr<devices::OpenController> device;
    devices::ControllerModel model;
    std::unique_ptr<SoundPort> sound{}; ///< a DualSense's on a cable, which plays instead; may be null
    std::string lesser{};               ///< why it does not play samples as it could; empty otherwise
    std::string name{};                 ///< for people; its path where it has none

    /// Whether it is still there, as far as the system tells: a sound server would go on elsewhere. [worker]
    [[nodiscard]] bool isThere() const;
};

/// Opens one of connectedControllers(), to play in `way`, or where that is not possible by rumble. Errors: those of
/// OpenController::open() and modelOf(). [worker]
[[nodiscard]] Result<OpenedController> openToPlay(const devices::Controller& controller, DualSenseWay way);

} // namespace pacini::live
