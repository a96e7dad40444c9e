#pragma once

// Look-up of game controllers and other haptic devices by the name that the user gives.

#include "devices/ControllerReports.h"
#include "devices/HidList.h"
#include "io/Fields.h"
#include "live/OpenedController.h"

#include <pacini/foundation/Result.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::cli
{

/// "HD rumble", "DualShock 4" ...
[[nodiscard]] std::string_view hapticsName(devices::ControllerHaptics haptics);

/// "USB", "Bluetooth", "Receiver" or "unknown".
[[nodiscard]] std::string_view transportName(devices::Transport transport);

/// The controllers that can be named without being connected: "switch", "dualsense-bluetooth" ...
[[nodiscard]] std::vector<std::string> modelNames();

/// The controller of one of those names; of any other, the first.
[[nodiscard]] devices::ControllerModel modelNamed(std::string_view name);

/// Returns the named device of `connected`: by its number from 1 on, its path, or a part of its name, ignoring case.
/// Without a name, returns the only game controller, or the only device if there is no game controller (a notebook's
/// touchpad is always connected). None if it is not connected. Errors: `invalidArgument` if several match.
[[nodiscard]] Result<std::optional<devices::Controller>>
chosenController(const std::vector<devices::Controller>& connected, const std::string& named);

/// What chosenController() finds among those that are connected now.
struct FoundController
{
    std::optional<devices::Controller> controller;
    Error missing; ///< why there is none, for commands that can wait for one
};

/// Looks for the named controller. Errors: those of devices::connectedControllers() and chosenController().
[[nodiscard]] Result<FoundController> findController(const std::string& named);

inline constexpr std::array<Choice<live::DualSenseWay>, 3> dualSenseWays{
    {{"samples", live::DualSenseWay::samples},
     {"long-samples", live::DualSenseWay::longSamples},
     {"rumble", live::DualSenseWay::rumble}}};
inline constexpr const char* dualSenseHelp = "How a DualSense plays: samples (its sound device on a cable, report 32 "
                                             "on Bluetooth), long-samples (report 36 where "
                                             "that stays silent) or rumble";

/// The name of a controller, or its path where it has none, with what a terminal can show.
[[nodiscard]] std::string shownName(const devices::Controller& controller);

/// As live::openToPlay(), with errors that name the controller. [worker]
[[nodiscard]] Result<live::OpenedController> openedController(const devices::Controller& controller,
                                                              live::DualSenseWay way);

} // namespace pacini::cli
