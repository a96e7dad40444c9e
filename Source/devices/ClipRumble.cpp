#include "devices/ClipRumble.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace pacini::devices
{

namespace
{
bool isHigh(Hertz frequency) noexcept
{
    return frequency >= carrierBorder;
}
} // namespace

RumbleTones withPulse(RumbleTones tones, const RumbleTone& pulse) noexcept
{
    if (!canSound(pulse))
        return tones;
    RumbleTone& carrier = isHigh(pulse.frequency) ? tones.high : tones.low;
    carrier = joinedTones(carrier, {pulse.frequency, std::min(pulse.amplitude, 1.0)});
    return tones;
}

MotorLevels motorsOf(std::span<const RumbleTone> bands) noexcept
{
    double low = 0.0;
    double high = 0.0;
    for (const RumbleTone& band : bands)
        if (canSound(band))
            (isHigh(band.frequency) ? high : low) += band.amplitude * band.amplitude;
    return {std::min(std::sqrt(low), 1.0), std::min(std::sqrt(high), 1.0)};
}

MotorLevels withPulse(const MotorLevels& motors, const EventPulse& pulse) noexcept
{
    const double amplitude = std::min(pulse.tone.amplitude, 1.0);
    return {std::max(motors.strong, amplitude * std::sqrt(1.0 - pulse.sharpness)),
            std::max(motors.weak, amplitude * std::sqrt(pulse.sharpness))};
}

ClipRumble::ClipRumble(Clip clip, const PlayRange& range, Decibels intensity, ControllerHaptics controller)
    : haptics(controller),
      interval(pacingOf(controller).interval),
      packets(std::move(clip), range, intensity.gain(), interval),
      handover({.interval = interval})
{
}

std::optional<RumbleState> ClipRumble::at(std::int64_t packet)
{
    const PacketContent content = packets.at(packet);
    RumbleState state = silentState(haptics);
    const RumbleState silence = state;
    if (haptics == ControllerHaptics::hdRumble)
        state = sidesFor(content);
    else
        state = motorsFor(packet, content);
    const auto count = packets.count();
    if (count && packet >= *count && state == silence)
        return std::nullopt;
    return state;
}

SidesRumble ClipRumble::sidesFor(const PacketContent& content) noexcept
{
    RumbleBytes bytes = handover.next(content.bands);
    if (content.event)
        bytes = encodeRumble(withPulse(handover.played(), content.event->tone));
    return {bytes, bytes};
}

MotorLevels ClipRumble::motorsFor(std::int64_t packet, const PacketContent& content) noexcept
{
    if (content.event)
    {
        motorEvent = *content.event;
        motorEventEnd = packet + std::llround(motorPulse.value / interval.value);
    }
    const MotorLevels motors = motorsOf(content.bands);
    return packet < motorEventEnd ? withPulse(motors, motorEvent) : motors;
}

} // namespace pacini::devices
