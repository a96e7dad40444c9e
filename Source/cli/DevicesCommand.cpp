#include "cli/DevicesCommand.h"

#include "devices/HidList.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string>

namespace pacini::cli
{

namespace
{
std::string hapticsName(devices::ControllerHaptics haptics)
{
    switch (haptics)
    {
    case devices::ControllerHaptics::hdRumble:
        return "HD rumble";
    case devices::ControllerHaptics::dualShock4:
        return "DualShock 4";
    case devices::ControllerHaptics::dualSense:
        return "DualSense";
    case devices::ControllerHaptics::xbox:
        return "Xbox";
    }
    return "";
}

std::string transportName(devices::Transport transport)
{
    switch (transport)
    {
    case devices::Transport::usb:
        return "USB";
    case devices::Transport::bluetooth:
        return "Bluetooth";
    case devices::Transport::unknown:
        break;
    }
    return "unknown";
}
} // namespace

CLI::App* DevicesCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("devices", "List the connected game controllers that can play haptics");
    command->add_flag("--json", json, "Print one JSON object");
    command->footer("Known are Joy-Con, Switch Pro, DualShock 4, DualSense and, on Bluetooth, Xbox controllers.");
    return command;
}

Exit DevicesCommand::run(Console& console)
{
    using Json = nlohmann::ordered_json;
    const auto controllers = devices::connectedControllers();
    if (!controllers)
    {
        console.error("", controllers.error());
        return Exit::failed;
    }
    Json list = Json::array();
    std::string lines;
    for (const auto& controller : *controllers)
    {
        const std::string haptics = hapticsName(controller.haptics);
        const std::string transport = transportName(controller.transport);
        list.push_back(
            {{"name", controller.name}, {"haptics", haptics}, {"transport", transport}, {"path", controller.path}});
        lines += fmt::format("{}{}  {:<11}  {:<9}  {}", lines.empty() ? "" : "\n", printable(controller.path), haptics,
                             transport, printable(controller.name));
    }
    if (json)
        console.print(Json{{"controllers", list}}.dump(2, ' ', false, Json::error_handler_t::replace));
    else
        console.print(lines.empty() ? "No known game controller is connected" : lines);
    return Exit::ok;
}

} // namespace pacini::cli
