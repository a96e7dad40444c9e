#pragma once

// HD rumble: the four bytes of two sinusoids for a Joy-Con or one side of a Pro Controller.

#include <pacini/foundation/Units.h>

#include <array>
#include <cstddef>

namespace pacini::devices
{

/// One sinusoid of an actuator; amplitude is linear, 1 = the strongest that is safe for the actuator.
struct RumbleTone
{
    Hertz frequency;
    double amplitude = 0.0;
    bool operator==(const RumbleTone&) const = default;
};

/// The tones of one side: two sinusoids whose ranges overlap. Silent, it stands at the resonances of the actuator.
struct RumbleTones
{
    RumbleTone high{Hertz(320.0), 0.0};
    RumbleTone low{Hertz(160.0), 0.0};
    bool operator==(const RumbleTones&) const = default;
};

using RumbleBytes = std::array<std::byte, 4>;

/// Both sinusoids silent at 320 and 160 Hz: the packet that stops an actuator.
inline constexpr RumbleBytes neutralRumble{std::byte{0x00}, std::byte{0x01}, std::byte{0x40}, std::byte{0x40}};

/// Frequencies are 10 Hz * 2^(step / 32); each range ends a little before the code does.
inline constexpr int lowestHighStep = 0x61;  ///< 81.75 Hz
inline constexpr int highestHighStep = 0xDF; ///< 1252.57 Hz
inline constexpr int lowestLowStep = 0x41;   ///< 40.88 Hz
inline constexpr int highestLowStep = 0xBF;  ///< 626.29 Hz

/// Amplitude codes. Those above `safeAmplitudeCode` exist, but can damage the actuator; they are never written.
inline constexpr int highestAmplitudeCode = 127; ///< 1.800
inline constexpr int safeAmplitudeCode = 100;    ///< 1.003

/// The frequency of a step, any integer.
[[nodiscard]] Hertz rumbleFrequency(int step) noexcept;

/// The step nearest to a frequency in ratio, within lowest..highest; a frequency that is not above 0 gives the lowest.
[[nodiscard]] int rumbleStep(Hertz frequency, int lowest, int highest) noexcept;

/// The linear amplitude of a code, which is brought into 0..127. The published table falls into three geometric rows,
/// of 4, 16 and 32 codes per doubling, and a smallest entry of its own; these closed forms give its safe entries within
/// 1e-5 and the others within 2e-4.
[[nodiscard]] double rumbleAmplitude(int code) noexcept;

/// The code nearest to an amplitude: in ratio, between 0 and the smallest in difference. Never above
/// `safeAmplitudeCode`; what is not above 0 (NaN too) gives 0. Drivers that drop amplitudes under 0.12 lose their
/// fades; here all codes are used.
[[nodiscard]] int rumbleAmplitudeCode(double amplitude) noexcept;

/// The bytes of two sinusoids. Frequencies go into the ranges above. When the amplitudes add up to more than 1, both
/// shrink in proportion, and after rounding their sum is not above that of the strongest single code. Two silent
/// sinusoids give `neutralRumble` whatever their frequencies.
///
/// Source: dekuNukem, Nintendo_Switch_Reverse_Engineering, rumble_data_table.md; the same numbers are in Linux'
/// hid-nintendo and in SDL. [any]
[[nodiscard]] RumbleBytes encodeRumble(const RumbleTones& tones) noexcept;

} // namespace pacini::devices
