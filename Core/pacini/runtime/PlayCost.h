#pragma once

// Prediction of the time that plays take on the audio thread.

#include <pacini/synthesis/DecoderParams.h>

#include <algorithm>
#include <cstddef>

namespace pacini
{

/// Predicted times, ns. Fitted once by least squares to the times of engines with plays of the corpus (`pacini bench
/// runtime` shows how well it holds) in a release build; never measured while playing, so that the same commands make
/// the same output on every machine. On another machine all of them change by much the same factor.
struct PlayCost
{
    static constexpr double frame = 9.0;       ///< a frame of a play: interpolator, faders, delay line
    static constexpr double send = 1.2;        ///< a frame towards an actuator that its pan reaches
    static constexpr double innerFrame = 14.0; ///< a frame at the inner rate: levelling
    static constexpr double carrier = 2.0;     ///< a frame of a sinusoid at the inner rate
    static constexpr double noise = 60.0;      ///< a frame of a band of noise at the inner rate
    static constexpr double pulse = 3.0;       ///< a frame while a pulse sounds
    static constexpr double pulseSeconds = 0.012;
    static constexpr double actuator = 10.0; ///< a frame of an actuator without plays: output filter, protection

    /// Of one decoder whose clip lasts `seconds` and goes to `sends` actuators, for a frame at `fs`.
    [[nodiscard]] static double of(const DecoderReport& decoder, double seconds, std::size_t sends, double fs) noexcept
    {
        const double inner = innerFrame * (decoder.levelled ? 1.0 : 0.3) +
                             carrier * static_cast<double>(decoder.carriers) +
                             noise * static_cast<double>(decoder.noiseBands);
        const double sounding =
            std::min(4.0, pulseSeconds * static_cast<double>(decoder.pulses) / std::max(seconds, pulseSeconds));
        return frame + send * static_cast<double>(sends) + inner * decoder.innerRate / fs + pulse * sounding;
    }
};

} // namespace pacini
