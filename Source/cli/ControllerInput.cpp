#include "cli/ControllerInput.h"

#include "cli/Console.h"
#include "io/Fields.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <utility>

namespace pacini::cli
{

namespace
{
using devices::Controller;
using devices::ControllerHaptics;
using devices::ControllerModel;
using devices::Transport;

constexpr std::array<std::pair<std::string_view, ControllerModel>, 12> knownModels{{
    {"switch", {ControllerHaptics::hdRumble, Transport::bluetooth}},
    {"switch-usb", {ControllerHaptics::hdRumble, Transport::usb}},
    {"dualshock4", {ControllerHaptics::dualShock4, Transport::usb}},
    {"dualshock4-bluetooth", {ControllerHaptics::dualShock4, Transport::bluetooth}},
    {"dualsense", {ControllerHaptics::dualSense, Transport::usb}},
    {"dualsense-bluetooth", {ControllerHaptics::dualSense, Transport::bluetooth}},
    {"xbox", {ControllerHaptics::xbox, Transport::bluetooth}},
    {"steam", {ControllerHaptics::steamController, Transport::usb}},
    {"steam-receiver", {ControllerHaptics::steamController, Transport::receiver}},
    {"steam-bluetooth", {ControllerHaptics::steamController, Transport::bluetooth}},
    {"steamdeck", {ControllerHaptics::steamDeck, Transport::usb}},
    {"waveforms", {ControllerHaptics::waveforms, Transport::usb, devices::standardTrigger()}},
}};

char lowered(char c)
{
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool holdsText(std::string_view text, std::string_view part)
{
    const auto alike = [](char a, char b)
    {
        return lowered(a) == lowered(b);
    };
    return std::search(text.begin(), text.end(), part.begin(), part.end(), alike) != text.end();
}
} // namespace

std::string_view hapticsName(ControllerHaptics haptics)
{
    constexpr std::array<std::string_view, 7> names{"HD rumble", "DualShock 4", "DualSense", "Xbox",
                                                    "Waveforms", "Steam",       "Steam Deck"};
    static_assert(names.size() == static_cast<std::size_t>(ControllerHaptics::steamDeck) + 1);
    return names[static_cast<std::size_t>(haptics)];
}

std::string_view transportName(Transport transport)
{
    constexpr std::array<Choice<Transport>, 4> names{{{"USB", Transport::usb},
                                                      {"Bluetooth", Transport::bluetooth},
                                                      {"Receiver", Transport::receiver},
                                                      {"unknown", Transport::unknown}}};
    return nameOf(transport, names);
}

std::vector<std::string> modelNames()
{
    std::vector<std::string> names;
    for (const auto& [name, model] : knownModels)
        names.emplace_back(name);
    return names;
}

ControllerModel modelNamed(std::string_view name)
{
    const auto found =
        std::find_if(knownModels.begin(), knownModels.end(), [&](const auto& m) { return m.first == name; });
    ControllerModel model = found != knownModels.end() ? found->second : knownModels.front().second;
    model.samples = devices::usualModel(model.haptics, model.transport).samples;
    return model;
}

Result<std::optional<Controller>> chosenController(const std::vector<Controller>& connected, const std::string& named)
{
    if (const auto number = parseNumber<std::size_t>(named))
    {
        if (*number < 1 || *number > connected.size())
            return std::optional<Controller>();
        return std::optional(connected[*number - 1]);
    }
    std::vector<Controller> meant;
    for (const Controller& controller : connected)
    {
        if (!named.empty() && controller.path == named)
            return std::optional(controller);
        if (holdsText(controller.name, named))
            meant.push_back(controller);
    }
    const auto isGamePad = [](const Controller& controller)
    {
        return controller.haptics != ControllerHaptics::waveforms;
    };
    if (named.empty() && std::any_of(meant.begin(), meant.end(), isGamePad))
        meant.erase(std::remove_if(meant.begin(), meant.end(), std::not_fn(isGamePad)), meant.end());
    if (meant.size() > 1)
        return Error{ErrorCode::invalidArgument, "",
                     fmt::format("matches {} controllers; choose one with --device and its number in 'pacini devices'",
                                 meant.size())};
    if (meant.empty())
        return std::optional<Controller>();
    return std::optional(meant.front());
}

Result<FoundController> findController(const std::string& named)
{
    const auto connected = devices::connectedControllers();
    if (!connected)
        return connected.error();
    const auto chosen = chosenController(*connected, named);
    if (!chosen)
        return chosen.error();
    return FoundController{*chosen,
                           {ErrorCode::io, "",
                            connected->empty()
                                ? "no supported game controller is connected; connect one, or wait for it with --wait"
                                : "no such controller is connected; 'pacini devices' lists the connected ones"}};
}

std::string shownName(const Controller& controller)
{
    return printable(controller.name.empty() ? controller.path : controller.name);
}

Result<live::OpenedController> openedController(const Controller& controller, live::DualSenseWay way)
{
    auto opened = live::openToPlay(controller, way);
    if (opened)
    {
        opened->name = shownName(controller);
        return opened;
    }
    Error error = opened.error();
    error.where = shownName(controller);
    return error;
}

} // namespace pacini::cli
