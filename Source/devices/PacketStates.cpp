#include "devices/PacketStates.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pacini::devices
{

namespace
{
constexpr double packetRounding = 1e-6; // of a packet
/// An event's waveform lasts longer than its strongest 4 ms. They have this part in its power, its packet the rest; all
/// of it would play clicks up to 2.8 dB above the drive. From a rumble it stands out by 3 dB.
constexpr double strongestPart = 0.25;
constexpr double standingOut = 1.4; // 3 dB

std::int64_t packetsIn(double intervals) noexcept
{
    return std::max<std::int64_t>(std::llround(intervals), 1);
}
} // namespace

MotorLevels motorsOf(std::span<const RumbleTone> tones) noexcept
{
    double low = 0.0;
    double high = 0.0;
    for (const RumbleTone& tone : tones)
        if (canSound(tone))
            (tone.frequency >= carrierBorder ? high : low) += tone.amplitude * tone.amplitude;
    return {std::min(std::sqrt(low), 1.0), std::min(std::sqrt(high), 1.0)};
}

PacketStates::PacketStates(const ControllerModel& controller)
    : model(controller),
      interval(pacingOf(controller).interval),
      sides{RumbleMapper({.interval = interval}), RumbleMapper({.interval = interval})}
{
}

RumbleState PacketStates::of(std::int64_t packet, const PacketContent& left, const PacketContent& right)
{
    if (model.haptics == ControllerHaptics::waveforms)
        return waveformFor(packet, left);
    if (!hasSides())
        return motorsFor(packet, left);
    return SidesRumble{sides[0].next(left.tones), sides[1].next(right.tones)};
}

MotorLevels PacketStates::motorsFor(std::int64_t packet, const PacketContent& content) noexcept
{
    const MotorLevels motors = motorsOf(content.tones);
    if (content.event)
    {
        const bool alone = static_cast<double>(packet - motorEventStart) * interval.value >= rollGap.value;
        motorEventStart = packet;
        motorEvent = alone ? motors : MotorLevels{};
    }
    if (static_cast<double>(packet - motorEventStart) * interval.value >= motorPulse.value - packetRounding)
        return motors;
    return {std::max(motors.strong, motorEvent.strong), std::max(motors.weak, motorEvent.weak)};
}

WaveformState PacketStates::waveformFor(std::int64_t packet, const PacketContent& content) noexcept
{
    if (model.trigger.event == 0)
        return lastingFor(packet, motorsFor(packet, content));
    const MotorLevels levels = motorsOf(content.tones);
    if (content.event)
    {
        const double lasting = levels.strong * levels.strong + levels.weak * levels.weak;
        const double power = lasting + strongestPart * (*content.event * *content.event - lasting);
        const double before = played.waveform == Waveform::event ? 0.0 : played.intensity;
        const double level = std::max(std::sqrt(power), std::min(standingOut * before, *content.event));
        played = {Waveform::event, std::min(level, 1.0), true};
        playedEnd = packet + packetsIn(std::ceil(model.trigger.eventTime.value / interval.value - packetRounding));
        return played;
    }
    if (played.waveform == Waveform::event && packet < playedEnd)
    {
        played.begins = false;
        return played;
    }
    return lastingFor(packet, levels);
}

WaveformState PacketStates::lastingFor(std::int64_t packet, const MotorLevels& levels) noexcept
{
    const double intensity = std::min(std::hypot(levels.strong, levels.weak), 1.0);
    if (!(intensity > 0.0) || !model.trigger.lasts())
        return played = {};
    const Waveform waveform = levels.strong > levels.weak ? Waveform::rumble : Waveform::buzz;
    const Seconds time = waveform == Waveform::rumble ? model.trigger.rumbleTime : model.trigger.buzzTime;
    const bool goesOn = played.waveform == waveform && (time.value <= 0.0 || packet < playedEnd);
    if (!goesOn)
        playedEnd = packet + packetsIn(std::floor(time.value / interval.value + packetRounding));
    // What goes on by itself needs no trigger of its own; one that ends does.
    return played = {waveform, intensity, !goesOn && time.value > 0.0};
}

} // namespace pacini::devices
