#pragma once

// The reports that carry haptics to a Steam Controller (2026) and a Steam Deck.
//
// Nothing here was tried on a device. Sources: SDL, steam/controller_structs.h and SDL_hidapi_steamdeck.c (ids, sizes,
// rumble); of the samples, which SDL does not send, players whose authors ran them: TritonLib, SteamHapticsPlayer,
// steam-controller-live-haptics.

#include "devices/KnownControllers.h"
#include "devices/MotorLevels.h"
#include "devices/PcmBlock.h"
#include "devices/Report.h"

#include <cstddef>
#include <cstdint>

namespace pacini::devices
{

/// Form of the samples on a connection.
struct SteamStream
{
    std::uint8_t format = 0; ///< the controller's number for it
    int rate = 8000;         ///< Hz
    std::size_t samples = 0; ///< of each side in a report
    bool muLaw = false;      ///< G.711, else 16-bit
};

/// On a cable 8 kHz at 16 bits (a report every 1.875 ms), by the receiver 8 kHz in mu-law (every 3.875 ms), on
/// Bluetooth 1 kHz in mu-law (every 31 ms). [any]
[[nodiscard]] constexpr SteamStream steamStream(Transport transport) noexcept
{
    if (transport == Transport::bluetooth)
        return {11, 1000, 31, true};
    if (transport == Transport::receiver)
        return {8, 8000, 31, true};
    return {0, 8000, 15, false};
}

/// Report 0x88: samples for the grips and the trackpads, left and right. [any]
[[nodiscard]] Report steamSamplesReport(const SteamStream& stream, const PcmBlock& block) noexcept;

/// Command of report 0x86 for a pair of actuators.
enum class SteamSwitch : std::uint8_t
{
    off = 1,
    on = 2,
};

/// The pairs of actuators that report 0x86 knows.
enum class SteamPair : std::uint8_t
{
    grips = 2,
    trackpads = 5,
};

/// Report 0x86: starts or ends playing samples of a format. [any]
[[nodiscard]] Report steamSwitchReport(SteamSwitch what, SteamPair pair, std::uint8_t format) noexcept;

/// Feature report 0xEB of a Steam Deck: its motors' levels, which it is told again while they last. The left is given
/// 2 dB more, as SDL does. [any]
[[nodiscard]] Report steamDeckReport(const MotorLevels& motors) noexcept;

} // namespace pacini::devices
