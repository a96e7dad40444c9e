#pragma once

// Frequency mapping: moves frequencies outside the range of an actuator into it.

#include <pacini/actuator/Profile.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Portable.h>

#include <cmath>

namespace pacini
{

/// Frequency mapping curve. Maps any frequency in Hz into [low, high]. Negative ones and NaN count as the lowest. In
/// all modes the map is a pure function, real-time safe, and leaves what is in the range already as it is, except for
/// `rescale`:
///
/// - clamp: the nearest end. Continuous and never falling.
/// - rescale: 30 to 1000 Hz onto the range, linear in octaves, the ends beyond that. Continuous and never falling;
/// equal
///   intervals stay equal.
/// - fold: by whole octaves into the range; of several octaves that fit the one nearest to the resonance (in octaves;
///   of two equally near ones the lower). When none fits, because the range is narrower than an octave, the end that
///   is nearest to one of the octaves. Pitch classes survive where an octave fits; the map jumps where another octave
///   gets nearer.
class FrequencyMap
{
public:
    static constexpr double sourceLow = 30.0;    ///< Hz, what clips hold
    static constexpr double sourceHigh = 1000.0; ///< Hz

    FrequencyMap() = default;

    /// Maps into the range of a valid profile.
    explicit FrequencyMap(const Profile& profile) noexcept
        : mapping(profile.frequencyMapping),
          low(profile.range.lowFrequency),
          high(profile.range.highFrequency),
          resonance(profile.resonance.frequency),
          exponent(portable::log(high / low) / portable::log(sourceHigh / sourceLow))
    {
    }

    [[nodiscard]] double operator()(double frequency) const noexcept
    {
        if (mapping == FrequencyMapping::rescale)
            return clampTo(low * portable::pow(clampTo(frequency, sourceLow, sourceHigh) / sourceLow, exponent), low,
                           high);
        const double nearestEnd = clampTo(frequency, low, high);
        if (mapping == FrequencyMapping::clamp || frequency == nearestEnd || !(frequency > 0.0))
            return nearestEnd;
        return folded(clampTo(frequency, smallest, largest));
    }

private:
    static constexpr double smallest = 1e-6; // Hz: keeps the logarithm finite
    static constexpr double largest = 1e9;

    [[nodiscard]] double folded(double frequency) const noexcept
    {
        double best = std::ldexp(frequency, static_cast<int>(std::floor(std::log2(high / frequency))));
        if (best > high) // the logarithm was rounded
            best *= 0.5;
        if (best < low) // the next octave is above the range: which is nearer to it?
            return low / best <= 2.0 * best / high ? low : high;
        // Going down brings it nearer to the resonance as long as that is not passed by more than it was above.
        while (0.5 * best >= low && 0.5 * best * best >= resonance * resonance)
            best *= 0.5;
        return best;
    }

    FrequencyMapping mapping = FrequencyMapping::clamp;
    double low = sourceLow;
    double high = sourceHigh;
    double resonance = 67.0;
    double exponent = 1.0;
};

} // namespace pacini
