#pragma once

// Pulse voices of the translator: a few pulses that may sound at once.

#include <pacini/synthesis/TransientPulse.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

namespace pacini
{

/// Pulse voices. Pulses that begin at once; one more than there is room for takes the place of the oldest, which is
/// then almost over.
class EventPulses
{
public:
    void reset() noexcept { *this = EventPulses(); }

    /// From frame `after` of the next call of addTo() on.
    void begin(const Pulse& pulse, double gain, std::size_t after) noexcept
    {
        voices[next] = {PulseVoice(pulse), gain, after};
        next = (next + 1) % voices.size();
        ++sounding;
    }

    [[nodiscard]] bool silent() const noexcept { return sounding == 0; }

    void addTo(std::span<float> out) noexcept
    {
        sounding = 0;
        for (Voice& voice : voices)
            if (!voice.pulse.finished())
            {
                const std::size_t wait = std::min(std::exchange(voice.after, 0), out.size());
                voice.pulse.addTo(out.subspan(wait), voice.gain);
                sounding += voice.pulse.finished() ? 0u : 1u;
            }
    }

private:
    struct Voice
    {
        PulseVoice pulse;
        double gain = 0.0;
        std::size_t after = 0;
    };

    std::array<Voice, 4> voices{};
    std::size_t next = 0;
    std::size_t sounding = 0;
};

} // namespace pacini
