#pragma once

// Levels that the motors of a controller are told by a report, for tests: an own reading of the layouts.

#include "devices/ControllerReports.h"

#include <cstddef>
#include <utility>

namespace pacini::test
{

/// The numbers of the strong and the weak motor, 0 to 1, as they stand in a report of levels.
[[nodiscard]] inline devices::MotorLevels toldNumbers(const devices::ControllerModel& model,
                                                      const devices::Report& report)
{
    const auto content = report.content();
    const auto at = [&](std::size_t place)
    {
        return static_cast<double>(std::to_integer<int>(content[place]));
    };
    switch (model.haptics)
    {
    case devices::ControllerHaptics::xbox:
        return {at(4) / 100.0, at(5) / 100.0};
    case devices::ControllerHaptics::steamDeck:
        return {(at(6) + 256.0 * at(7)) / 65535.0, (at(8) + 256.0 * at(9)) / 65535.0};
    default:
        break;
    }
    const bool isOld = model.haptics == devices::ControllerHaptics::dualShock4;
    const bool isBluetooth = model.transport == devices::Transport::bluetooth;
    const std::size_t weak = isOld ? (isBluetooth ? 6 : 4) : (isBluetooth ? 5 : 3);
    return {at(weak + 1) / 255.0, at(weak) / 255.0};
}

/// The levels that these numbers mean by the controller's curves.
[[nodiscard]] inline devices::MotorLevels toldLevels(const devices::ControllerModel& model,
                                                     const devices::Report& report)
{
    const auto [strong, weak] = devices::motorCurves(model);
    const devices::MotorLevels numbers = toldNumbers(model, report);
    return {strong.level(numbers.strong), weak.level(numbers.weak)};
}

} // namespace pacini::test
