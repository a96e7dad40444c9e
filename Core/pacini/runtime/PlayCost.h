#pragma once

// Prediction of the time that plays take on the audio thread.

#include <pacini/synthesis/DecoderParams.h>

#include <algorithm>
#include <cstddef>

namespace pacini
{

/// Predicted times, ns. Fitted once, by least squares of relative errors without negative terms, to release builds of
/// 160 engines with 16 plays each, of 0 to 12 sinusoids, 0 to 3 bands of noise, 0 to 20 events a second, with and
/// without an envelope, on 1 to 8 actuators: of the predictions 9 in 10 were 0.7 to 1.3 times what was measured. Never
/// measured while playing, so that the same commands make the same output on every machine; on another one all of them
/// change by much the same factor. Sinusoids and levelling are taken at 0.78 of that, as clips of sounds have them
/// (`pacini bench runtime`), and what a play costs that is left out was read off there.
struct PlayCost
{
    static constexpr double waiting = 0.2;        ///< a frame of any play, left out or not: looking after it
    static constexpr double frame = 0.1;          ///< a frame of a play that sounds: interpolator, faders
    static constexpr double send = 0.45;          ///< a frame towards each of the two actuators nearest to its pan
    static constexpr double levelledFrame = 16.5; ///< a frame at the inner rate that is levelled to an envelope
    static constexpr double carrier = 4.5;        ///< a frame of a sinusoid at the inner rate
    static constexpr double noise = 28.5;         ///< a frame of a band of noise at the inner rate
    static constexpr double pulse = 7.3;          ///< a frame while a pulse sounds
    static constexpr double pulseSeconds = 0.012; ///< of a pulse
    static constexpr double mostPulses = 4.0;     ///< at a time
    static constexpr double texture = 8.0;        ///< a frame of a texture of order 32 (`pacini bench textures`)
    static constexpr double tone = 0.5;           ///< a frame of each of its tones
    static constexpr double actuator = 0.4;       ///< a frame of an actuator without plays

    /// Of one decoder whose clip lasts `seconds` and goes to `actuators`, for a frame at `fs`.
    [[nodiscard]] static double of(const DecoderReport& decoder, double seconds, std::size_t actuators,
                                   double fs) noexcept
    {
        const double inner = (decoder.levelled ? levelledFrame : 0.0) +
                             carrier * static_cast<double>(decoder.carriers) +
                             noise * static_cast<double>(decoder.noiseBands);
        const double sounding = pulseSeconds * static_cast<double>(decoder.pulses) / std::max(seconds, pulseSeconds);
        return frame + send * static_cast<double>(std::min<std::size_t>(actuators, 2)) +
               inner * decoder.innerRate / fs + pulse * std::min(sounding, mostPulses);
    }
};

} // namespace pacini
