#include "live/LiveRumble.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace pacini::live
{

namespace
{
constexpr Seconds samplesWait{0.010}; // in the queue of what plays samples
} // namespace

LiveRumble::LiveRumble(LiveDrive& arriving, double sampleRate, const devices::ControllerModel& controller)
    : drive(arriving), interval(devices::pacingOf(controller).interval.value), measure(sampleRate), states(controller)
{
    if (!devices::sampleStream(controller))
        return;
    tracked.emplace(drive, sampleRate, sampleRate, static_cast<std::size_t>(samplesWait.value * sampleRate));
    samples.emplace([this](std::span<const std::span<float>> out) { tracked->read(out[0]); }, 1, sampleRate,
                    controller);
}

std::size_t LiveRumble::takeAll()
{
    // What comes meanwhile is for the next packet, or a sound that is quicker than this would never end.
    std::size_t left = drive.waiting();
    const std::size_t all = left;
    while (left > 0)
    {
        const std::size_t got = drive.take(std::span(block).first(std::min(left, block.size())));
        measure.add(std::span(block).first(got));
        left -= got;
    }
    return all;
}

std::optional<devices::RumbleState> LiveRumble::at(std::int64_t packet)
{
    const bool over = drive.isOver();
    if (samples)
        return over ? std::nullopt : samples->at(packet);
    const auto passed = static_cast<double>(packet - last) * interval;
    last = packet;
    if (takeAll() > 0)
    {
        held = measure.take();
        idle = 0.0;
        const auto state = states.of(packet, held);
        held.event.reset();
        return state;
    }
    if (over)
        return std::nullopt;
    idle += passed;
    if (idle > patience.value)
        held = {};
    return states.of(packet, held);
}

} // namespace pacini::live
