#pragma once

// Heard voice: sound above the range of touch, felt in proportion to its loudness.

#include <pacini/filters/DesignLimits.h>
#include <pacini/filters/StateVariable.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/HeardLaw.h>
#include <pacini/foundation/Units.h>
#include <pacini/realtime/CarrierVoice.h>
#include <pacini/realtime/ControlHop.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>

namespace pacini
{

/// Heard voice, the live form of HeardBeside: a sinusoid of 280 to 380 Hz, higher for brighter sounds, for sound above
/// 900 Hz. A sine of 1 kHz at half of full scale has a loudness of 1, which is full drive at its onset. Loudness is
/// that of three bands (S. Stevens, "On the psychophysical law", 1957; weights and memory as in HeardLevel).
class HeardVoice
{
public:
    /// Its pitch stays within `bottom` to `top`, Hz; `fs` (Hz) is the inner rate. Real-time safe; silence follows.
    void design(double bottom, double top, double fs) noexcept
    {
        rate = fs;
        low = bottom;
        highest = top;
        weighting = StateVariableLoop::design(clampedFrequency(Hertz(280.0), fs), 2.0, fs);
        split = StateVariableLoop::design(clampedFrequency(Hertz(1100.0), fs), std::numbers::sqrt2, fs);
        quickShare = hopShare(0.0035, fs);
        slowShare = hopShare(0.070, fs);
        steadyShare = hopShare(heardSteadySeconds, fs);
        reset();
    }

    void reset() noexcept
    {
        weightingState = splitState = {};
        oscillator.reset();
        energies = {};
        loudness = above = {};
        steady = felt = unmasked = 0.0;
        pitch = low;
    }

    /// Sets its amount, 0 to 1, at once.
    void jump(double audible) noexcept { wanted.jump(audible); }

    /// Whether the voice is off and has decayed. process() may then be skipped.
    [[nodiscard]] bool silent() const noexcept { return wanted.silent() && oscillator.silent(); }

    /// Returns its amount in the coming hop, 0 to 1.
    [[nodiscard]] double share() const noexcept { return wanted.end(); }

    /// Starts a hop. `audible` (0 to 1) moves by the fraction `gainShare` of the distance to its target; `gain` is that
    /// of the voice. `own` is the amplitude of all bands as played, `lowPower` the power (amplitude squared) of the low
    /// ones.
    void aim(double audible, double gain, double gainShare, double own, double lowPower) noexcept
    {
        wanted.aim(audible, gainShare);
        if (silent())
            return;
        hear();
        const double before = std::exchange(unmasked, heardBesidePower(wanted.end() * felt, own, lowPower));
        if (oscillator.silent() && unmasked > 0.0) // it begins between two points of the grid, where the power was 0
            oscillator.noteEvent(static_cast<double>(controlHop) * unmasked / (unmasked - std::min(before, 0.0)));
        oscillator.aim(gain * std::sqrt(std::max(0.0, unmasked)), 1.0, pitch / rate);
    }

    /// Before aim(): see CarrierOscillator.
    void noteEvent(double frames) noexcept { oscillator.noteEvent(frames); }

    /// Processes frames of the hop from `at` on: analyses `in` and `highs`, the levels (RMS) of the part above it or
    /// empty, and adds to `out`.
    void process(std::span<const double> in, std::span<const double> highs, std::span<double> out,
                 std::size_t at) noexcept
    {
        for (std::size_t i = 0; i < in.size(); ++i)
        {
            const double x = weightingState.tick(weighting, in[i]).high;
            const StateVariableOutputs parts = splitState.tick(split, x);
            energies[0] += parts.low * parts.low;
            energies[1] += parts.high * parts.high;
        }
        for (const double x : highs)
            energies[2] += x * x;
        if (!oscillator.silent())
            oscillator.addTo(out, at);
    }

    void flush() noexcept
    {
        weightingState.flush();
        splitState.flush();
        for (Memory* memory : {&loudness, &above})
        {
            flushTiny(memory->quick);
            flushTiny(memory->slow);
        }
        flushTiny(steady);
    }

private:
    /// Smoothing by 3.5 and 70 ms.
    struct Memory
    {
        double quick = 0.0;
        double slow = 0.0;
    };

    [[nodiscard]] double remembered(Memory& memory, double value) const noexcept
    {
        memory.quick += quickShare * (value - memory.quick);
        memory.slow += slowShare * (value - memory.slow);
        return 0.47 * memory.quick + 0.53 * memory.slow;
    }

    /// Updates from the loudness of the last hop.
    void hear() noexcept
    {
        std::array<double, 3> parts{};
        for (std::size_t b = 0; b < parts.size(); ++b)
            parts[b] = loudnessOf(energies[b] / static_cast<double>(controlHop), weights[b]);
        const double all = energies[0] + energies[1] + energies[2];
        const double share = all > 0.0 ? (energies[1] + energies[2]) / all : 0.0;
        energies = {};
        const double high = parts[1] + parts[2];
        const double now = heardAbove(remembered(loudness, parts[0] + high), remembered(above, high), share);
        steady += steadyShare * (now - steady);
        felt = heardRise(now, steady);
        if (high > 0.0)
            pitch = clampTo(heardPitch(parts[2] / high), low, highest);
    }

    /// In float, which takes a third of the time; the seventh digit is inaudible.
    [[nodiscard]] static double loudnessOf(double power, double weight) noexcept
    {
        return weight * static_cast<double>(std::pow(static_cast<float>(power), 0.3f));
    }

    /// Of widths in critical bands (8, 7 and 8.5, to the .7), so that a sine of 1 kHz and amplitude .5 has 1.
    static constexpr std::array<double, 3> weights{1.28, 1.17, 1.34};

    double rate = 6000.0;
    double low = 0.0, highest = 0.0; // Hz
    StateVariableLoop weighting;     // two one-poles at 280 Hz: A-weighting within 2 dB from 50 Hz to 3 kHz
    StateVariableLoop split;         // at 1100 Hz: of 700 Hz .14 counts as above, of 900 Hz .31
    double quickShare = 1.0, slowShare = 1.0, steadyShare = 1.0;

    StateVariableState weightingState, splitState;
    CarrierOscillator oscillator;
    HopRamp wanted;
    std::array<double, 3> energies{}; // of this hop
    Memory loudness, above;           // of all that is heard and of what lies above
    double steady = 0.0;              // loudness as it was of late
    double felt = 0.0;                // level of the sinusoid where nothing else is felt
    double unmasked = 0.0;            // power of the sinusoid beside the rest; below 0 where that masks it
    double pitch = 0.0;               // Hz
};

} // namespace pacini
