#pragma once

// Mapping of a clip's bands to the two sinusoids of an HD rumble actuator, packet after packet.

#include "devices/HdRumble.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace pacini::devices
{

/// From here on, in Hz, a tone is nearer to the carrier at 320 Hz than to the one at 160 Hz.
inline constexpr Hertz carrierBorder{160.0 * std::numbers::sqrt2};

/// Two tones as one, frequencies above 0: energies add up, and they weigh the logarithms of the frequencies. A tone
/// between two bands sounds in both and so comes out at its own pitch.
[[nodiscard]] inline RumbleTone joinedTones(const RumbleTone& a, const RumbleTone& b) noexcept
{
    const double energyA = a.amplitude * a.amplitude;
    const double energy = energyA + b.amplitude * b.amplitude;
    if (!(energy > 0.0))
        return {a.frequency, 0.0};
    const double logRatio = std::log(b.frequency.value / a.frequency.value);
    return {Hertz(a.frequency.value * std::exp(logRatio * (1.0 - energyA / energy))), std::min(std::sqrt(energy), 1.0)};
}

/// Whether a tone is one: amplitude and frequency are finite and above 0.
[[nodiscard]] inline bool canSound(const RumbleTone& tone) noexcept
{
    return tone.amplitude > 0.0 && std::isfinite(tone.amplitude) && tone.frequency.value > 0.0 &&
           std::isfinite(tone.frequency.value);
}

/// What the two carriers should play for the tones of some bands, in any order. Each band belongs to the carrier that
/// it is nearest to, of 320 and 160 Hz, where the actuator is strongest; the two strongest bands of a carrier make its
/// tone, so that quiet neighbours do not pull its pitch. Bands that are silent, or whose numbers are not finite, do not
/// count; a carrier without bands stands silent at its own frequency. Amplitudes are at most 1, frequencies within
/// those of HD rumble. [any]
[[nodiscard]] inline RumbleTones carriersOf(std::span<const RumbleTone> bands) noexcept
{
    constexpr RumbleTones home;
    std::array<RumbleTone, 2> high{home.high, home.high};
    std::array<RumbleTone, 2> low{home.low, home.low};
    const Hertz lowest = rumbleFrequency(lowestLowStep);
    const Hertz highest = rumbleFrequency(highestHighStep);
    for (const RumbleTone& band : bands)
    {
        if (!canSound(band))
            continue;
        const RumbleTone tone{std::clamp(band.frequency, lowest, highest), std::min(band.amplitude, 1.0)};
        auto& strongest = tone.frequency < carrierBorder ? low : high;
        if (tone.amplitude > strongest[0].amplitude)
            strongest = {tone, strongest[0]};
        else if (tone.amplitude > strongest[1].amplitude)
            strongest[1] = tone;
    }
    return {joinedTones(high[0], high[1]), joinedTones(low[0], low[1])};
}

/// Smoothing of the packets. A time is how long it takes to come within 37 % (1/e) of a new value; 0 follows at once.
struct RumbleMapperParams
{
    Seconds interval{0.015};      ///< from packet to packet, above 0
    Seconds amplitudeTime{0.010}; ///< about the rise time of the actuator
    Seconds pitchTime{0.020};
    bool operator==(const RumbleMapperParams&) const = default;
};

/// Smoothed mapping for one side of a controller. Jumps make an actuator click; therefore amplitudes and logarithms of
/// frequencies go to their targets exponentially, so never beyond them, and independently of the interval. A carrier
/// that starts from silence starts at its new frequency, as nobody has felt another; one that fades out keeps its
/// frequency.
class RumbleMapper
{
public:
    explicit RumbleMapper(const RumbleMapperParams& params = {}) noexcept
        : amplitudeShare(share(params.interval, params.amplitudeTime)),
          pitchShare(share(params.interval, params.pitchTime))
    {
    }

    /// Silent, as a new one.
    void reset() noexcept { tones = {}; }

    /// The packet for the next interval; `bands` as in carriersOf(). After silent bands have faded out, within ten
    /// times `amplitudeTime`, it is `neutralRumble`. [any]
    [[nodiscard]] RumbleBytes next(std::span<const RumbleTone> bands) noexcept
    {
        const RumbleTones target = carriersOf(bands);
        follow(tones.high, target.high);
        follow(tones.low, target.low);
        return encodeRumble(tones);
    }

    /// What the last packet plays, before it was rounded to codes and limited to a sum of 1.
    [[nodiscard]] const RumbleTones& played() const noexcept { return tones; }

private:
    static double share(Seconds interval, Seconds time) noexcept
    {
        return time.value > 0.0 ? -std::expm1(-interval.value / time.value) : 1.0;
    }

    void follow(RumbleTone& tone, const RumbleTone& target) const noexcept
    {
        if (tone.amplitude == 0.0)
            tone.frequency = target.frequency;
        else if (target.amplitude > 0.0)
            tone.frequency.value *= std::pow(target.frequency.value / tone.frequency.value, pitchShare);
        tone.amplitude += amplitudeShare * (target.amplitude - tone.amplitude);
        if (target.amplitude == 0.0 && rumbleAmplitudeCode(tone.amplitude) == 0)
            tone.amplitude = 0.0;
    }

    double amplitudeShare;
    double pitchShare;
    RumbleTones tones;
};

} // namespace pacini::devices
