#include "devices/DriveMeasure.h"

#include "devices/RumbleMapper.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pacini::devices
{

namespace
{
constexpr int filterOrder = 4;
constexpr double pitchKept = 0.5; // of the packets before, in a pitch: a packet may hold less than a period
constexpr double standing = 0.05; // of squares, from packet to packet
constexpr double eventRise = 2.5;
constexpr double leastEvent = 0.05; // of full drive
constexpr double shortTime = 0.004; // s
constexpr double levelTime = 0.035; // s, in which a level that has ended falls to 37 % (1/e)
constexpr double inaudible = 1e-4;  // -80 dB: decaying states of filters are silence
} // namespace

DriveMeasure::DriveMeasure(double sampleRate)
    : fs(sampleRate), scratch(blockFrames), shortLength(static_cast<std::size_t>(std::ceil(shortTime * sampleRate)))
{
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
        parts[i].filter.prepare({fs, blockFrames});
        parts[i].filter.setParams({.type = i == 0 ? ButterworthType::lowpass : ButterworthType::highpass,
                                   .order = filterOrder,
                                   .frequency = carrierBorder});
    }
}

void DriveMeasure::add(std::span<const float> samples) noexcept
{
    for (const float sample : samples)
    {
        const double square = static_cast<double>(sample) * static_cast<double>(sample);
        power += square;
        shortPower += square;
        if (++shortFrames == shortLength)
        {
            loudest = std::max(loudest, shortPower / static_cast<double>(shortLength));
            shortPower = 0.0;
            shortFrames = 0;
        }
    }
    const std::span<float> filtered = std::span(scratch).first(samples.size());
    for (Part& part : parts)
    {
        part.filter.process(samples, filtered);
        for (const float sample : filtered)
        {
            const auto x = static_cast<double>(sample);
            part.power += x * x;
            part.steps += (x - part.last) * (x - part.last);
            part.last = x;
        }
    }
    frames += samples.size();
}

PacketContent DriveMeasure::take(std::optional<bool> eventBegins)
{
    PacketContent content;
    if (frames == 0)
        return content;
    const auto count = static_cast<double>(frames);
    std::array<double, 2> squares{}; // of amplitudes
    for (std::size_t i = 0; i < parts.size(); ++i)
        squares[i] = parts[i].takeSquares() / count;
    const double both = squares[0] + squares[1];
    const bool stands = std::abs(both - lastSquares) <= standing * lastSquares;
    const double level = std::sqrt(stands ? both : 2.0 * power / count);
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
        const double share = both > 0.0 ? squares[i] / both : 0.0;
        const RumbleTone tone{parts[i].pitch(fs), level * std::sqrt(share)};
        if (tone.amplitude > inaudible)
            content.tones.push_back(tone);
    }
    content.event = eventAt(eventBegins);
    lastSquares = both;
    power = 0.0;
    frames = 0;
    return content;
}

std::optional<double> DriveMeasure::eventAt(std::optional<bool> known) noexcept
{
    const double strongest = std::sqrt(2.0 * loudest);
    const bool begins = known.value_or(strongest >= leastEvent && strongest > eventRise * heldLevel);
    heldLevel = std::max(strongest, heldLevel * std::exp(-static_cast<double>(frames) / fs / levelTime));
    loudest = 0.0;
    const double here = std::min(strongest, 1.0);
    const double either = std::max(here, lastEvent); // a packet may begin just after its event
    lastEvent = here;
    if (!begins || either <= inaudible)
        return std::nullopt;
    return either;
}

double DriveMeasure::Part::takeSquares() noexcept
{
    pitchPower = pitchKept * pitchPower + power;
    pitchSteps = pitchKept * pitchSteps + steps;
    const double squares = power + (pitchSteps > 0.0 ? steps * pitchPower / pitchSteps : 0.0);
    power = steps = 0.0;
    return squares;
}

Hertz DriveMeasure::Part::pitch(double sampleRate) const noexcept
{
    if (!(pitchPower > 0.0))
        return carrierBorder;
    return Hertz(sampleRate / std::numbers::pi * std::asin(std::min(0.5 * std::sqrt(pitchSteps / pitchPower), 1.0)));
}

} // namespace pacini::devices
