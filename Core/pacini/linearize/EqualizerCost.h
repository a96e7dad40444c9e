#pragma once

// Cost of an equalizer for its actuator: power in the coil and travel of the mass.

#include <pacini/actuator/Profile.h>
#include <pacini/foundation/Units.h>
#include <pacini/linearize/EqualizerCurve.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

namespace pacini
{

/// The spectrum of the drive before the equalizer.
enum class ReferenceSpectrum
{
    flat, ///< equal power per Hz
    pink  ///< equal power per octave
};

/// Change of power and excursion by an equalizer.
struct EqualizerCost
{
    double powerChange = 0.0;        ///< dB, of the power in the coil for the reference spectrum in the profile's range
    std::optional<double> power;     ///< W with the equalizer, for a drive of the power of a full sinusoid
    double excursionFrequency = 0.0; ///< Hz, where a sinusoid moves the mass farthest
    double excursionChange = 0.0;    ///< dB, of that largest excursion
    std::optional<double> excursion; ///< share of maxExcursion for a sinusoid of amplitude 1 before the equalizer
};

/// The cost of `sections` on an actuator, in the range of the profile up to 0.49 of the sample rate fs (Hz); the
/// profile is valid. The coil is its resistance: power is proportional to the squared drive, 2 maxVoltageRms^2 /
/// impedance at a drive of 1 (see coilHeatParams). The mass is a second-order resonator, x = excursion / (s^2 + s/q +
/// 1), s = j f / f0 (see ActuatorDrive). So without a protection behind the equalizer: a peak of 16 dB at 30 Hz, as M.
/// Weber, "A Framework for Audio-Tactile Signal Translation", 2020, Table 3.2 has it and left out again since it heats
/// the coil, is here 40 times the power where it acts.
[[nodiscard]] inline EqualizerCost equalizerCost(const Profile& profile, const EqualizerSections& sections, double fs,
                                                 ReferenceSpectrum reference = ReferenceSpectrum::pink)
{
    constexpr int points = 2000;
    const double high = std::min(profile.range.highFrequency, 0.49 * fs);
    const double low = std::min(profile.range.lowFrequency, 0.5 * high);
    const BiquadCascadeCoefficients filter = designEqualizer(sections, fs);
    double plain = 0.0, equalized = 0.0, farthestPlain = 0.0, farthest = 0.0;
    EqualizerCost cost;
    for (int i = 0; i <= points; ++i)
    {
        const double f = low * std::pow(high / low, static_cast<double>(i) / points);
        const double gain = std::abs(filter.response(Hertz(f), fs));
        // steps of equal ratio hold equal power of pink noise; the first and last count half
        const double density = (reference == ReferenceSpectrum::pink ? 1.0 : f) * (i == 0 || i == points ? 0.5 : 1.0);
        plain += density;
        equalized += density * gain * gain;
        const std::complex<double> s(0.0, f / profile.resonance.frequency);
        const double travel = 1.0 / std::abs(s * s + s / profile.resonance.q + 1.0);
        farthestPlain = std::max(farthestPlain, travel);
        if (gain * travel > farthest)
        {
            farthest = gain * travel;
            cost.excursionFrequency = f;
        }
    }
    cost.powerChange = Decibels::fromPower(equalized / plain).value;
    cost.excursionChange = Decibels::fromGain(farthest / farthestPlain).value;
    const ActuatorDrive& drive = profile.drive;
    if (drive.impedance && drive.maxVoltageRms)
        cost.power = *drive.maxVoltageRms * *drive.maxVoltageRms / *drive.impedance * equalized / plain;
    if (drive.excursion && drive.maxExcursion)
        cost.excursion = farthest * *drive.excursion / *drive.maxExcursion;
    return cost;
}

} // namespace pacini
