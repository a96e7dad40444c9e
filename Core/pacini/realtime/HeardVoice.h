#pragma once

// Heard voice: sound above the range of touch, felt in proportion to its loudness.

#include <pacini/filters/DesignLimits.h>
#include <pacini/filters/StateVariable.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>
#include <pacini/realtime/CarrierVoice.h>
#include <pacini/realtime/ControlHop.h>
#include <pacini/realtime/LiveOnsetDetector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

namespace pacini
{

/// Heard voice. Live form of AudibleBlend: where most of what is heard (A-weighted power over the last second) lies
/// above 900 Hz, a sinusoid of 150 to 290 Hz, the brighter the higher, follows the loudness, and the bands are to
/// be played at bandsGain(). A sine of 1 kHz at half of full scale has a loudness of 1, the most
/// that is felt; ten decibels less are half of it.
/// Loudness is that of three bands (S. Stevens, "On the psychophysical law", 1957; weights and memory as in
/// HeardLevel). Even trains of events stay with their pulses. What live sound will be is not known, so the share looks
/// back only.
class HeardVoice
{
public:
    /// Its pitch stays within `lowest` to `highest`, Hz; `fs` (Hz) is the inner rate. Real-time safe; silence follows.
    void design(double lowest, double highest, double fs) noexcept
    {
        rate = fs;
        low = clampTo(lowestPitch, lowest, highest);
        high = clampTo(highestPitch, lowest, highest);
        weighting = StateVariableLoop::design(clampedFrequency(Hertz(280.0), fs), 2.0, fs);
        split = StateVariableLoop::design(clampedFrequency(Hertz(1100.0), fs), std::numbers::sqrt2, fs);
        secondShare = hopShare(1.0, fs);
        quickShare = hopShare(0.0035, fs);
        slowShare = hopShare(0.070, fs);
        trainShare = hopShare(0.020, fs);
        reset();
    }

    void reset() noexcept
    {
        weightingState = splitState = {};
        oscillator.reset();
        energies = {};
        quick = slow = total = above = 0.0;
        felt = taken = 0.0;
        alike = 0;
        sinceEvent = 0;
        gap = strength = 0.0;
        train = 0.0;
    }

    /// How far it goes, 0 to 1, at once.
    void jump(double audible) noexcept { wanted.jump(audible); }

    /// Whether nobody wants it and nothing is left of it: then process() may be left out.
    [[nodiscard]] bool silent() const noexcept { return wanted.silent() && oscillator.silent(); }

    /// How far it has taken over in the coming hop, 0 to 1.
    [[nodiscard]] double share() const noexcept { return taken; }
    /// By which the bands are to be scaled then, 0.25 to 1.
    [[nodiscard]] double bandsGain() const noexcept { return 1.0 - taken * (1.0 - kept); }

    /// An event as it is found.
    void noteEvent(const HeardEvent& event) noexcept
    {
        const auto isNear = [](double a, double b)
        {
            return std::min(a, b) >= 0.7 * std::max(a, b);
        };
        const bool follows = event.gap < longestGap && isNear(event.amplitude, strength) && isNear(event.gap, gap);
        alike = follows ? std::min(alike + 1, fewestAlike) : 0;
        gap = event.gap;
        strength = event.amplitude;
        sinceEvent = 0;
    }

    /// At the start of a hop: `audible` (0 to 1) goes the part `gainShare` of its way; `gain` is that of the voice.
    void aim(double audible, double gain, double gainShare) noexcept
    {
        wanted.aim(audible, gainShare);
        if (silent())
            return;
        hear();
        oscillator.aim(gain * taken * felt, 1.0, pitch / rate);
    }

    /// Frames `at` and on of the hop: listens to `in` and to `highs`, what lies above it, or nothing; adds to `out`.
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
        for (double* value : {&quick, &slow, &total, &above})
            flushTiny(*value);
    }

private:
    /// Loudness of the last hop, and what follows from it.
    void hear() noexcept
    {
        std::array<double, 3> power{};
        for (std::size_t b = 0; b < power.size(); ++b)
            power[b] = energies[b] / static_cast<double>(controlHop);
        energies = {};
        const double bright = loudnessOf(power[2], weights[2]);
        const double middle = loudnessOf(power[1], weights[1]);
        const double loudness = loudnessOf(power[0], weights[0]) + middle + bright;
        quick += quickShare * (loudness - quick);
        slow += slowShare * (loudness - slow);
        total += secondShare * (power[0] + power[1] + power[2] - total);
        above += secondShare * (power[1] + power[2] - above);
        const double remembered = 0.47 * quick + 0.53 * slow;
        felt = loudestLevel * std::clamp((remembered - unheard) / (1.0 - unheard), 0.0, 1.0);
        if (middle + bright > 0.0)
            pitch = low + (high - low) * bright / (middle + bright);

        ++sinceEvent;
        const double hops = gap * rate / static_cast<double>(controlHop);
        const bool inTrain = alike == fewestAlike && static_cast<double>(sinceEvent) < 2.0 * hops;
        train += trainShare * ((inTrain ? 1.0 : 0.0) - train);
        flushTiny(train);
        const double u = std::clamp((above / (total + 1e-16) - none) / (all - none), 0.0, 1.0);
        taken = wanted.end() * (1.0 - train) * u * u * (3.0 - 2.0 * u);
    }

    /// In float: ears do not hear the seventh digit, and it takes a third of the time.
    [[nodiscard]] static double loudnessOf(double power, double weight) noexcept
    {
        return weight * static_cast<double>(std::pow(static_cast<float>(power), 0.3f));
    }

    static constexpr double lowestPitch = 150.0;  // Hz
    static constexpr double highestPitch = 290.0; // Hz
    static constexpr double none = 0.15;          // of the power
    static constexpr double all = 0.35;
    static constexpr double kept = 0.25;
    static constexpr double unheard = 0.03;
    static constexpr double loudestLevel = 0.8;
    static constexpr double longestGap = 0.045; // s, in a train
    static constexpr int fewestAlike = 3;       // pairs of gaps: five events
    /// Of widths in critical bands (8, 7 and 8.5, to the .7), so that a sine of 1 kHz and amplitude .5 has 1.
    static constexpr std::array<double, 3> weights{1.28, 1.17, 1.34};

    double rate = 6000.0;
    double low = lowestPitch, high = highestPitch;
    StateVariableLoop weighting; // two one-poles at 280 Hz: A-weighting within 2 dB from 50 Hz to 3 kHz
    StateVariableLoop split;     // at 1100 Hz: of 700 Hz .14 counts as above, of 900 Hz .31
    double secondShare = 1.0, quickShare = 1.0, slowShare = 1.0, trainShare = 1.0;

    StateVariableState weightingState, splitState;
    CarrierOscillator oscillator;
    HopRamp wanted;
    std::array<double, 3> energies{}; // of this hop
    double quick = 0.0, slow = 0.0;   // loudness
    double total = 0.0, above = 0.0;  // power
    double felt = 0.0;                // level of the sinusoid
    double taken = 0.0;               // share
    double pitch = lowestPitch;
    int alike = 0;                    // pairs of gaps so far
    std::uint64_t sinceEvent = 0;     // control hops
    double gap = 0.0, strength = 0.0; // of the newest event
    double train = 0.0;               // 1 within an even train
};

} // namespace pacini
