#include "devices/ClipRumble.h"

#include "devices/ClipEvents.h"

#include <cmath>

namespace pacini::devices
{

namespace
{
constexpr double driveRate = 48000.0; // Hz; as `pacini render` unless it is told
} // namespace

ClipRumble::ClipRumble(const Clip& clip, const PlayRange& range, Decibels intensity, const ControllerModel& controller,
                       const Profile* profile)
    : model(controller),
      drive(clipDrive(clip, range, intensity, driveRate, profile), 1, driveRate, controller,
            [events = ClipEvents(clip, range, pacingOf(controller).interval)](std::int64_t packet) mutable
            { return events.at(packet); })
{
    const double length = range.to.value - range.from.value;
    if (!range.loop)
        count = static_cast<std::int64_t>(std::floor(length / pacingOf(controller).interval.value + 0.5)) + 1;
}

std::optional<RumbleState> ClipRumble::at(std::int64_t packet)
{
    const bool over = count && packet >= *count;
    const auto state = drive.at(packet);
    if (over && state == silentState(model))
        return std::nullopt;
    return state;
}

} // namespace pacini::devices
