#include "live/OpenedController.h"

#include "devices/SoundCard.h"

#include <filesystem>
#include <system_error>
#include <utility>

namespace pacini::live
{

devices::ControllerModel playedIn(devices::ControllerModel model, DualSenseWay way) noexcept
{
    using devices::DualSenseSamples;
    if (model.samples != DualSenseSamples::none)
        model.samples = way == DualSenseWay::rumble        ? DualSenseSamples::none
                        : way == DualSenseWay::longSamples ? DualSenseSamples::report36
                                                           : DualSenseSamples::report32;
    return model;
}

bool OpenedController::isThere() const
{
    std::error_code failed;
    return std::filesystem::exists(controller.path, failed);
}

namespace
{
/// Gives a DualSense on a cable its sound device.
void addSound(OpenedController& opened)
{
    const auto card = devices::soundCardOf(opened.controller.path);
    if (!card)
    {
        opened.lesser = "has no sound device here";
        return;
    }
    auto port = SoundPort::openDualSense(*card);
    if (!port)
    {
        opened.lesser = "has a sound device, of which " + port.error().message;
        return;
    }
    opened.sound = std::move(*port);
    for (const devices::TimedReport& each : devices::closingReports(opened.model, 0)) // no rumble that was left on
        static_cast<void>(opened.device->send(each.report));
}
} // namespace

Result<OpenedController> openToPlay(const devices::Controller& controller, DualSenseWay way)
{
    auto opened = devices::OpenController::open(controller.path);
    if (!opened)
        return opened.error();
    const auto model = devices::modelOf(controller, **opened);
    if (!model)
        return model.error();
    OpenedController made{controller, std::move(opened).value(), playedIn(*model, way)};
    made.name = controller.name.empty() ? controller.path : controller.name;
    if (controller.haptics != devices::ControllerHaptics::dualSense || way == DualSenseWay::rumble)
        return made;
    if (controller.transport != devices::Transport::bluetooth)
        addSound(made);
    else if (made.model.samples == devices::DualSenseSamples::none)
        made.lesser = "refuses samples";
    return made;
}

} // namespace pacini::live
