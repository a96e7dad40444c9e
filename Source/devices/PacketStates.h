#pragma once

// Conversion of packets (tones and an event) to the states of a controller (HD rumble, motors, waveforms).

#include "devices/ControllerReports.h"
#include "devices/PacketContent.h"
#include "devices/RumbleMapper.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>

namespace pacini::devices
{

/// The levels of two motors for tones: the energies below and above the border of the carriers of HD rumble, 226 Hz. So
/// a drive is split alike on all controllers; Linux (hid-nintendo.c) gives strong and weak motors the carriers' 160 and
/// 320 Hz. [any]
[[nodiscard]] MotorLevels motorsOf(std::span<const RumbleTone> tones) noexcept;

/// Converter of packets to the states of any controller that is not sent samples.
///
/// On waveforms (see chosenWaveforms()), an event is triggered in its packet at its level and interrupts the continuous
/// part until it has ended. The continuous part follows the levels of two motors: a rumble if the strong one is higher,
/// otherwise a buzz, with the intensity of both together.
class PacketStates
{
public:
    /// For how long motors are held up, at the levels of the packet in which an event begins: a shorter push is not
    /// felt. Source: Lofelt, NiceVibrations, which plays emphasis on motors for 30 ms.
    static constexpr Seconds motorPulse{0.030};

    /// An event that comes sooner after another is part of a roll, which held motors would fill up. Ours.
    static constexpr Seconds rollGap{0.080};

    explicit PacketStates(const ControllerModel& controller);

    /// Whether the two sides of a controller play for themselves.
    [[nodiscard]] bool hasSides() const noexcept { return model.haptics == ControllerHaptics::hdRumble; }

    /// What a packet plays; packets only go forward, some may be left out. [worker]
    [[nodiscard]] RumbleState of(std::int64_t packet, const PacketContent& content)
    {
        return of(packet, content, content);
    }

    /// The same with two sides; where hasSides() is not true, the left is played. [worker]
    [[nodiscard]] RumbleState of(std::int64_t packet, const PacketContent& left, const PacketContent& right);

private:
    [[nodiscard]] MotorLevels motorsFor(std::int64_t packet, const PacketContent& content) noexcept;
    [[nodiscard]] WaveformState waveformFor(std::int64_t packet, const PacketContent& content) noexcept;
    [[nodiscard]] WaveformState lastingFor(std::int64_t packet, const MotorLevels& levels) noexcept;

    ControllerModel model;
    Seconds interval;
    std::array<RumbleMapper, 2> sides;
    MotorLevels motorEvent;                                                  ///< at which they are held up
    std::int64_t motorEventStart = std::numeric_limits<std::int32_t>::min(); ///< its packet
    WaveformState played;
    std::int64_t playedEnd = 0; ///< the packet at which what is played has ended by itself
};

} // namespace pacini::devices
