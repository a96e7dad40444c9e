#pragma once

// Look-up of game controllers and other haptic devices by the name that the user gives.

#include "devices/ControllerReports.h"
#include "devices/HidList.h"
#include "devices/OpenController.h"

#include <pacini/foundation/Result.h>

#include <memory>
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

/// The one of `connected` that is meant: by its number from 1 on, its path, or a part of its name, upper and lower case
/// alike. When nothing is named it is the only game controller, or without any the only device: a notebook's touchpad
/// is always there. Nothing when it is not there. Errors: `invalidArgument` when several could be meant.
[[nodiscard]] Result<std::optional<devices::Controller>>
chosenController(const std::vector<devices::Controller>& connected, const std::string& named);

/// The name of a controller, or its path where it has none, with what a terminal can show.
[[nodiscard]] std::string shownName(const devices::Controller& controller);

/// A controller that is open for writing, and what it understands.
struct OpenedController
{
    devices::Controller controller;
    std::unique_ptr<devices::OpenController> device;
    devices::ControllerModel model;
};

/// Opens one of `connected`. Errors: those of OpenController::open() and modelOf(), with the controller's name.
/// [worker]
[[nodiscard]] Result<OpenedController> openedController(const devices::Controller& controller);

/// Why chosenController() found none of `connected`, for commands that can wait for one.
[[nodiscard]] Error notConnected(const std::vector<devices::Controller>& connected);

} // namespace pacini::cli
