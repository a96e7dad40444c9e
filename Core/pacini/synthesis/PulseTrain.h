#pragma once

// Pulse synthesis: the events of a clip, played one after another.

#include <pacini/synthesis/Roles.h>
#include <pacini/synthesis/TransientPulse.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pacini
{

/// An event that gets a pulse.
struct PulseEvent
{
    double clipFrame = 0.0; ///< where it stands in the clip, in output frames at the clip's own speed
    double gain = 0.0;      ///< linear
    double sharpness = 0.0; ///< 0-1
    double gap = 0.0;       ///< s to its nearest neighbour
};

/// Start of an event, and its pulse.
struct PulseStart
{
    std::int64_t frame = 0;     ///< of the output
    double rate = 1.0;          ///< speed of the clip there
    double transposition = 1.0; ///< factor of the pulse's frequency
};

/// Plays pulses that may overlap. Events are in order of time; nothing is computed for those that are not sounding.
class PulseTrain
{
public:
    PulseTrain() = default;
    PulseTrain(const PulseParams& shape, double fs) : params(shape), sampleRate(fs) {}

    void reserve(std::size_t count) { events.reserve(count); }
    void add(const PulseEvent& event) { events.push_back({event, {}}); }

    void reset() noexcept
    {
        firstSounding = 0;
        next = 0;
    }

    /// Adds the pulses to `out`, whose first frame is `position`. `startOf` gives the PulseStart of an event. An event
    /// that should have begun before is begun at once: changes of speed can come late. [audio]
    template <typename StartOf>
    void process(std::span<float> out, std::int64_t position, StartOf&& startOf) noexcept
    {
        play(out, position, startOf,
             [](Voice& voice, std::span<float> to, std::size_t) { voice.voice.addTo(to, voice.event.gain); });
    }

    /// The same at the level of a role. [audio]
    template <typename StartOf>
    void process(std::span<float> out, std::int64_t position, StartOf&& startOf, const RoleGain& level) noexcept
    {
        play(out, position, startOf,
             [&](Voice& voice, std::span<float> to, std::size_t from)
             {
                 if (level.steady() && level.at(0) == 0.0)
                     voice.voice.pass(to.size());
                 else
                     voice.voice.addTo(to, [&](std::size_t n) { return voice.event.gain * level.at(from + n); });
             });
    }

    /// Continues at frame `position`: pulses that began before are cut off. [audio]
    template <typename StartOf>
    void skipTo(std::int64_t position, StartOf&& startOf) noexcept
    {
        while (next < events.size() && startOf(events[next].event).frame < position)
            ++next;
        firstSounding = next;
    }

private:
    struct Voice
    {
        PulseEvent event;
        PulseVoice voice;
    };

    /// add(voice, to, from) adds an event from frame `from` on.
    template <typename StartOf, typename Add>
    void play(std::span<float> out, std::int64_t position, StartOf&& startOf, Add&& add) noexcept
    {
        for (std::size_t i = firstSounding; i < next; ++i)
            add(events[i], out, std::size_t{0});
        for (; next < events.size(); ++next)
        {
            Voice& voice = events[next];
            const PulseStart start = startOf(voice.event);
            if (start.frame >= position + static_cast<std::int64_t>(out.size()))
                break;
            voice.voice = PulseVoice(makePulse(params, voice.event.sharpness, voice.event.gap / start.rate, sampleRate,
                                               start.transposition));
            const auto from = static_cast<std::size_t>(std::max(start.frame - position, std::int64_t{0}));
            add(voice, out.subspan(from), from);
        }
        while (firstSounding < next && events[firstSounding].voice.finished())
            ++firstSounding;
    }

    PulseParams params;
    double sampleRate = 48000.0;
    std::vector<Voice> events;
    std::size_t firstSounding = 0;
    std::size_t next = 0;
};

} // namespace pacini
