#include "devices/DriveRumble.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini::devices
{

namespace
{
constexpr double longestGap = 1.0; // s

RationalDecimator decimatorTo(int rate, double fs)
{
    RationalDecimatorParams params;
    params.passFrequency = Hertz(0.4 * rate);
    params.stopFrequency = Hertz(0.6 * rate); // what it folds lands above 0.4
    return RationalDecimator(static_cast<int>(fs), rate, params);
}

std::int16_t sampleOf(float value) noexcept
{
    const double within = std::isfinite(value) ? std::clamp(static_cast<double>(value), -1.0, 1.0) : 0.0;
    return static_cast<std::int16_t>(std::lround(32767.0 * within));
}

/// Both sides as one, for a controller that has none.
PacketContent joined(PacketContent left, const PacketContent& right)
{
    left.tones.insert(left.tones.end(), right.tones.begin(), right.tones.end());
    if (right.event && (!left.event || *right.event > *left.event))
        left.event = right.event;
    return left;
}
} // namespace

bool DriveRumble::takesRate(double sampleRate, const ControllerModel& controller) noexcept
{
    const auto stream = sampleStream(controller);
    return !stream || (sampleRate >= stream->rate && sampleRate == std::floor(sampleRate));
}

DriveRumble::DriveRumble(DriveRenderer renderer, std::size_t channelCount, double sampleRate,
                         const ControllerModel& controller, DriveEvents knownEvents)
    : render(std::move(renderer)),
      events(std::move(knownEvents)),
      fs(sampleRate),
      stream(sampleStream(controller)),
      framesPerPacket(pacingOf(controller).interval.value * sampleRate),
      channels(channelCount, std::vector<float>(blockFrames)),
      outputs(channelCount),
      states(controller)
{
    for (std::size_t side = 0; side < sides(); ++side)
        if (stream)
            decimators.push_back(decimatorTo(stream->rate, fs));
        else
            measures.emplace_back(fs);
    decimated.resize(decimators.size());
}

void DriveRumble::pull(std::size_t frames)
{
    for (std::size_t c = 0; c < channels.size(); ++c)
        outputs[c] = std::span(channels[c]).first(frames);
    render(outputs);
    for (std::size_t side = 0; side < decimators.size(); ++side)
        decimators[side].push(outputs[side], decimated[side]);
    for (std::size_t side = 0; side < measures.size(); ++side)
        measures[side].add(outputs[side]);
}

PcmBlock DriveRumble::samplesOf()
{
    const std::size_t wanted = stream->samples;
    while (decimated[0].size() < wanted)
        pull(std::min(blockFrames, static_cast<std::size_t>(std::ceil(framesPerPacket))));
    PcmBlock block;
    for (std::size_t i = 0; i < wanted; ++i)
    {
        block.left[i] = sampleOf(decimated[0][i]);
        block.right[i] = sampleOf(decimated.back()[i]);
    }
    for (auto& side : decimated)
        side.erase(side.begin(), side.begin() + static_cast<std::ptrdiff_t>(wanted));
    return block;
}

std::optional<RumbleState> DriveRumble::at(std::int64_t packet)
{
    const auto most = static_cast<std::int64_t>(longestGap * fs / framesPerPacket);
    std::int64_t left = std::clamp(packet - nextPacket, std::int64_t{0}, most);
    nextPacket = packet + 1;
    if (!decimators.empty())
    {
        for (; left > 0; --left)
            static_cast<void>(samplesOf());
        return samplesOf();
    }
    PacketContent sidesContent[2];
    for (; left >= 0; --left)
    {
        owed += framesPerPacket;
        auto frames = static_cast<std::size_t>(owed);
        owed -= static_cast<double>(frames);
        while (frames > 0)
        {
            const std::size_t n = std::min(frames, blockFrames);
            pull(n);
            frames -= n;
        }
        const auto begins = events ? std::optional(events(packet - left)) : std::nullopt;
        for (std::size_t side = 0; side < measures.size(); ++side)
        {
            PacketContent content = measures[side].take(begins);
            if (!content.event)
                content.event = sidesContent[side].event; // of a packet that was left out
            sidesContent[side] = std::move(content);
        }
    }
    if (measures.size() == 1)
        return states.of(packet, sidesContent[0]);
    if (states.hasSides())
        return states.of(packet, sidesContent[0], sidesContent[1]);
    return states.of(packet, joined(std::move(sidesContent[0]), sidesContent[1]));
}

} // namespace pacini::devices
