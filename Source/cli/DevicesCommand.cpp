// Subcommand that lists the connected haptic devices.

#include "cli/Command.h"
#include "cli/ControllerInput.h"
#include "devices/HidList.h"
#include "devices/SoundCard.h"
#include "live/SoundPort.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

/// `pacini devices`: the connected game controllers that can play haptics.
class DevicesCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    Exit listSounds(Console& console) const;

    bool sounds = false;
};
} // namespace

CLI::App* DevicesCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("devices", "List connected game controllers and other haptic devices");
    command->add_flag("--sound", sounds, "List the sound devices that 'pacini live' can name instead");
    command->footer("'pacini play CLIP --device N' plays on device N.\nPacini supports Joy-Con, Switch Pro, DualShock "
                    "4, DualSense, Steam Controller (2026), Steam Deck,\nXbox controllers on Bluetooth, and as "
                    "'Waveforms' devices with waveforms of HID page 0x0E: some\ntouchpads, mice, pens and dials. The "
                    "Steam devices follow published sources and were not tested.");
    return command;
}

Exit DevicesCommand::listSounds(Console& console) const
{
    Json list = Json::array();
    std::string lines;
    for (const live::SoundDevice& device : live::SoundPort::devices())
    {
        list.push_back({{"name", device.name},
                        {"description", device.description},
                        {"inputs", device.inputs},
                        {"outputs", device.outputs}});
        lines +=
            fmt::format("{}{:>2} in {:>2} out  {}{}{}", lines.empty() ? "" : "\n", device.inputs, device.outputs,
                        printable(device.name), device.description.empty() ? "" : "  ", printable(device.description));
    }
    console.addToReport({{"soundDevices", list}});
    console.print(lines.empty() ? "No sound device is there" : lines);
    return Exit::ok;
}

Exit DevicesCommand::run(Console& console)
{
    if (sounds)
        return listSounds(console);
    const auto controllers = devices::connectedControllers();
    if (!controllers)
        return console.fail("", controllers.error());
    Json list = Json::array();
    std::string lines;
    for (const auto& controller : *controllers)
    {
        const auto haptics = hapticsName(controller.haptics);
        const auto transport = transportName(controller.transport);
        const std::size_t number = list.size() + 1;
        list.push_back({{"number", number},
                        {"name", controller.name},
                        {"haptics", haptics},
                        {"transport", transport},
                        {"path", controller.path}});
        if (controller.haptics == devices::ControllerHaptics::dualSense)
        {
            const auto card = devices::soundCardOf(controller.path);
            list.back()["soundCard"] = card ? Json(*card) : Json(nullptr);
        }
        lines += fmt::format("{}{:>2}  {}  {:<11}  {:<9}  {}", lines.empty() ? "" : "\n", number,
                             printable(controller.path), haptics, transport, printable(controller.name));
    }
    console.addToReport({{"controllers", list}});
    console.print(lines.empty() ? "No supported game controller is connected" : lines);
    return Exit::ok;
}

std::unique_ptr<Command> devicesCommand()
{
    return std::make_unique<DevicesCommand>();
}

} // namespace pacini::cli
