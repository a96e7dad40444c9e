#include "devices/OpenController.h"

#if defined(__linux__) && !defined(PACINI_AS_OTHER_SYSTEMS)
#include "devices/HidrawController.h"
#else
#include "devices/HidapiController.h"
#endif

namespace pacini::devices
{

Result<std::unique_ptr<OpenController>> OpenController::open(const std::string& path)
{
#if defined(__linux__) && !defined(PACINI_AS_OTHER_SYSTEMS)
    return openHidraw(path);
#else
    return openByHidapi(path);
#endif
}

Result<ControllerModel> modelOf(const Controller& controller, OpenController& open)
{
    ControllerModel model = usualModel(controller.haptics, controller.transport);
    if (controller.haptics == ControllerHaptics::dualSense)
    {
        constexpr std::uint8_t firmware = 0x20;
        const auto report = open.feature(firmware, 64);
        model.oldRumble = report && !hasImprovedRumble(controller.product, *report);
        if (model.samples != DualSenseSamples::none && !open.send(reportOf(model, PcmBlock{}, 0)))
            model.samples = DualSenseSamples::none;
    }
    if (!controller.waveforms)
        return model;
    const auto trigger = chosenWaveforms(*controller.waveforms, [&](std::uint8_t report, std::size_t bytes)
                                         { return open.feature(report, bytes); });
    if (!trigger)
        return trigger.error();
    model.trigger = *trigger;
    return model;
}

} // namespace pacini::devices
