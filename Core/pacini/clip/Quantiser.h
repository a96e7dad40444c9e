#pragma once

// Quantisers of time, level and pitch: the grids that clips are stored on.

#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pacini
{

/// `value` rounded to that many significant decimal digits: short numbers for people to read. `value` must be 0 or have
/// a magnitude in 1e-200-1e200.
[[nodiscard]] inline double roundedToDigits(double value, int digits) noexcept
{
    if (value == 0.0)
        return 0.0;
    const double scale = std::pow(10.0, digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value)))));
    return std::round(value * scale) / scale;
}

/// Uniform grid of 2^bits values over [low, high] (Weber 2020, section 4.3.2): code = floor((v - low) / (high - low) *
/// (2^bits - 1) + 0.5), clipped. The reading of the thesis.
class UniformQuantiser
{
public:
    /// `bits` in 1-31.
    constexpr UniformQuantiser(int bits, double low, double high) noexcept
        : top((std::int64_t{1} << bits) - 1), lowest(low), range(high - low)
    {
    }

    [[nodiscard]] std::int64_t code(double value) const noexcept
    {
        const double c = std::floor((value - lowest) / range * static_cast<double>(top) + 0.5);
        return static_cast<std::int64_t>(std::clamp(c, 0.0, static_cast<double>(top)));
    }
    [[nodiscard]] double value(std::int64_t code) const noexcept
    {
        return lowest + range * static_cast<double>(code) / static_cast<double>(top);
    }

private:
    std::int64_t top;
    double lowest;
    double range;
};

/// Amplitudes in equal steps of level: code 0 is silence, code c > 0 is full drive times 10^((c - top) * step / 20),
/// with 72 dB on 2^bits - 2 steps. Codes above `top` reach above full drive. Skin and ear judge ratios: at 6 bits a
/// step is 1.2 dB, about the smallest difference that skin notices, where a uniform grid of 6 bits has no value between
/// 0 and -36 dB.
class LevelQuantiser
{
public:
    static constexpr double range = 72.0;     ///< dB below full drive
    static constexpr double highest = 1000.0; ///< value of all higher codes

    /// `bits` in 4-16.
    constexpr explicit LevelQuantiser(int bits) noexcept
        : top((std::int64_t{1} << bits) - 1),
          step(range / static_cast<double>(top - 1)),
          digits(bits <= 8    ? 4
                 : bits <= 12 ? 6
                              : 8)
    {
    }

    [[nodiscard]] std::int64_t topCode() const noexcept { return top; }
    [[nodiscard]] std::int64_t code(double amplitude) const noexcept
    {
        if (!(amplitude > 0.0))
            return 0;
        const double c = static_cast<double>(top) + std::round(Decibels::fromGain(amplitude).value / step);
        return static_cast<std::int64_t>(std::clamp(c, 0.0, 1e9));
    }
    [[nodiscard]] double value(std::int64_t code) const noexcept
    {
        if (code <= 0)
            return 0.0;
        // Limited before it is rounded: a damaged file can hold any code.
        return roundedToDigits(std::min(highest, Decibels(static_cast<double>(code - top) * step).gain()), digits);
    }

private:
    std::int64_t top;
    double step;
    int digits; // enough that a value returns to its code
};

/// Frequencies in equal steps of pitch: 3 * 2^(bits - 2) steps per octave, code 0 at 1 Hz; at 6 bits 48 per octave (1.5
/// %; skin tells frequencies apart from about 10 % on).
class PitchQuantiser
{
public:
    static constexpr double lowest = 1e-3; ///< Hz; values outside become the limits
    static constexpr double highest = 4e5; ///< Hz

    constexpr explicit PitchQuantiser(int bits) noexcept
        : stepsPerOctave(3.0 * static_cast<double>(std::int64_t{1} << bits) / 4.0),
          digits(bits <= 8    ? 5
                 : bits <= 12 ? 6
                              : 8)
    {
    }

    /// Frequencies at or below 0 have no pitch: they get the lowest code, as does NaN, which a damaged file can hold.
    [[nodiscard]] std::int64_t code(double hertz) const noexcept
    {
        const double limited = hertz > lowest ? std::min(hertz, highest) : lowest;
        return static_cast<std::int64_t>(std::round(std::log2(limited) * stepsPerOctave));
    }
    [[nodiscard]] double value(std::int64_t code) const noexcept
    {
        return roundedToDigits(std::clamp(std::exp2(static_cast<double>(code) / stepsPerOctave), lowest, highest),
                               digits);
    }

private:
    double stepsPerOctave;
    int digits;
};

} // namespace pacini
