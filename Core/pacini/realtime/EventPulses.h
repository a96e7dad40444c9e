#pragma once

// A few pulses that may sound at once.

#include <pacini/synthesis/TransientPulse.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace pacini
{

/// Pulses that begin at once; one more than there is room for takes the place of the oldest, which is then almost over.
class EventPulses
{
public:
    void reset() noexcept { *this = EventPulses(); }

    void begin(const Pulse& pulse, double gain) noexcept
    {
        voices[next] = {PulseVoice(pulse), gain};
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
                voice.pulse.addTo(out, voice.gain);
                sounding += voice.pulse.finished() ? 0u : 1u;
            }
    }

private:
    struct Voice
    {
        PulseVoice pulse;
        double gain = 0.0;
    };

    std::array<Voice, 4> voices{};
    std::size_t next = 0;
    std::size_t sounding = 0;
};

} // namespace pacini
