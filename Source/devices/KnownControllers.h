#pragma once

// Table of the supported controllers: USB ids -> kind of haptics.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace pacini::devices
{

/// Kind of haptics of a controller, or of another haptic device.
enum class ControllerHaptics
{
    hdRumble,        ///< SwitchReports.h
    dualShock4,      ///< SonyReports.h
    dualSense,       ///< SonyReports.h
    xbox,            ///< XboxReport.h
    waveforms,       ///< WaveformReport.h
    steamController, ///< of 2026; SteamReports.h
    steamDeck,       ///< SteamReports.h
};

/// Connection of a controller.
enum class Transport
{
    unknown,
    usb,
    bluetooth,
    receiver, ///< radio whose receiver is on USB
};

/// What a controller understands, by its maker's and its product's USB numbers, which it has on Bluetooth too; nothing
/// for others. Xbox controllers are known by the numbers that they have on Bluetooth only, as they are no HID devices
/// on a cable. Sources: SDL, usb_ids.h, controller_list.h. [any]
[[nodiscard]] constexpr std::optional<ControllerHaptics> controllerHaptics(std::uint16_t maker,
                                                                           std::uint16_t product) noexcept
{
    struct Known
    {
        std::uint16_t maker;
        std::uint16_t product;
        ControllerHaptics haptics;
    };
    constexpr std::uint16_t nintendo = 0x057E;
    constexpr std::uint16_t sony = 0x054C;
    constexpr std::uint16_t microsoft = 0x045E;
    constexpr std::uint16_t valve = 0x28DE;
    constexpr std::array<Known, 22> all{{
        {nintendo, 0x2006, ControllerHaptics::hdRumble}, // left Joy-Con
        {nintendo, 0x2007, ControllerHaptics::hdRumble}, // right Joy-Con
        {nintendo, 0x2009, ControllerHaptics::hdRumble}, // Pro Controller
        {nintendo, 0x200E, ControllerHaptics::hdRumble}, // charging grip
        {sony, 0x05C4, ControllerHaptics::dualShock4},       {sony, 0x09CC, ControllerHaptics::dualShock4}, // slim
        {sony, 0x0BA0, ControllerHaptics::dualShock4}, // its wireless adapter
        {sony, 0x0CE6, ControllerHaptics::dualSense},        {sony, 0x0DF2, ControllerHaptics::dualSense}, // Edge
        {microsoft, 0x02E0, ControllerHaptics::xbox},                                                      // One S
        {microsoft, 0x02FD, ControllerHaptics::xbox},                                                      // One S
        {microsoft, 0x0B20, ControllerHaptics::xbox},        // One S, low energy
        {microsoft, 0x0B05, ControllerHaptics::xbox},        // Elite 2
        {microsoft, 0x0B22, ControllerHaptics::xbox},        // Elite 2, low energy
        {microsoft, 0x0B0C, ControllerHaptics::xbox},        // Adaptive
        {microsoft, 0x0B21, ControllerHaptics::xbox},        // Adaptive, low energy
        {microsoft, 0x0B13, ControllerHaptics::xbox},        // Series X and S
        {valve, 0x1302, ControllerHaptics::steamController}, // on a cable
        {valve, 0x1303, ControllerHaptics::steamController}, // Bluetooth
        {valve, 0x1304, ControllerHaptics::steamController}, // its receiver
        {valve, 0x1305, ControllerHaptics::steamController}, // another receiver
        {valve, 0x1205, ControllerHaptics::steamDeck},
    }};
    for (const Known& known : all)
        if (known.maker == maker && known.product == product)
            return known.haptics;
    return std::nullopt;
}

/// Whether a DualSense follows the closer likeness of rumble that came with firmware 2.24, by its feature report 0x20:
/// an Edge does, and so does one that does not tell its firmware. Source: SDL, SDL_hidapi_ps5.c. [any]
[[nodiscard]] constexpr bool hasImprovedRumble(std::uint16_t product,
                                               std::span<const std::byte> firmwareReport) noexcept
{
    if (product == 0x0DF2 || firmwareReport.size() < 46)
        return true;
    const unsigned version =
        std::to_integer<unsigned>(firmwareReport[44]) | std::to_integer<unsigned>(firmwareReport[45]) << 8;
    return version == 0 || version >= 0x0224;
}

/// The connection of a known controller that has another product number for each; nothing for the others. [any]
[[nodiscard]] constexpr std::optional<Transport> transportByProduct(ControllerHaptics haptics,
                                                                    std::uint16_t product) noexcept
{
    if (haptics != ControllerHaptics::steamController)
        return std::nullopt;
    return product == 0x1302 ? Transport::usb : product == 0x1303 ? Transport::bluetooth : Transport::receiver;
}

/// Whether a controller is one of several HID devices with the same numbers, such as the keyboard and the mouse that it
/// also is: it is the one with a usage page of its maker (FF00 to FFFF). [any]
[[nodiscard]] constexpr bool hasMakersPage(ControllerHaptics haptics) noexcept
{
    return haptics == ControllerHaptics::steamController || haptics == ControllerHaptics::steamDeck;
}

} // namespace pacini::devices
