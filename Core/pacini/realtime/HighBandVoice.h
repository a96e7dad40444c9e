#pragma once

// High-band voice: sounds too high for the skin, felt as a sinusoid where it feels best.

#include <pacini/filters/DesignLimits.h>
#include <pacini/filters/StateVariable.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>
#include <pacini/realtime/CarrierVoice.h>
#include <pacini/realtime/ControlHop.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace pacini
{

/// High-band voice. Skin hardly feels frequencies above a few hundred hertz, but rivers, bells and tyres lie there. The
/// strength above `border`, less the strength below it, which is felt anyway, becomes the strength of one sinusoid. A
/// sound that is felt already keeps its own shape; any other sound becomes its envelope.
class HighBandVoice
{
public:
    static constexpr double frequency = 200.0; ///< Hz, near to where skin feels best, well below the border
    static constexpr Hertz border{320.0};      ///< above it the felt weighting of HTS falls by 24 dB per octave

    /// Real-time safe; silence follows.
    void design(double fs) noexcept
    {
        split = StateVariableLoop::design(clampedFrequency(border, fs), std::numbers::sqrt2, fs);
        share = hopShare(0.004, fs);
        reset();
    }

    void reset() noexcept
    {
        state = {};
        oscillator.reset();
        lowEnergy = highEnergy = low = high = 0.0;
    }

    /// The gain at once.
    void jump(double wantedGain) noexcept { gain.jump(wantedGain); }

    /// Whether the voice is off and has decayed. process() may then be skipped.
    [[nodiscard]] bool silent() const noexcept { return gain.silent() && oscillator.silent(); }

    /// Starts a hop: the gain (linear) of the upper part moves by the fraction `gainShare` of the distance to
    /// `wantedGain`. Also sets the pitch.
    void aim(double wantedGain, double gainShare, double cyclesPerFrame) noexcept
    {
        gain.aim(wantedGain, gainShare);
        constexpr double frames = static_cast<double>(controlHop);
        low += share * (lowEnergy / frames - low);
        high += share * (highEnergy / frames - high);
        lowEnergy = highEnergy = 0.0;
        const double power = 2.0 * (gain.end() * gain.end() * high - low);
        const double wanted = power > 1e-14 ? std::sqrt(power) : 0.0;
        oscillator.aim(wanted, 1.0, cyclesPerFrame);
    }

    /// Before aim(): see CarrierOscillator.
    void noteEvent(double frames) noexcept { oscillator.noteEvent(frames); }

    /// Frames `at` and on of the hop: listens to `in`, adds to `out`.
    void process(std::span<const double> in, std::span<double> out, std::size_t at) noexcept
    {
        for (const double x : in)
        {
            const StateVariableOutputs parts = state.tick(split, x);
            lowEnergy += parts.low * parts.low;
            highEnergy += parts.high * parts.high;
        }
        if (!oscillator.silent())
            oscillator.addTo(out, at);
    }

    void flush() noexcept
    {
        state.flush();
        flushTiny(low);
        flushTiny(high);
    }

private:
    StateVariableLoop split;
    StateVariableState state;
    CarrierOscillator oscillator;
    HopGlide gain;
    double share = 1.0;
    double lowEnergy = 0.0, highEnergy = 0.0; // of this hop
    double low = 0.0, high = 0.0;             // smoothed powers
};

} // namespace pacini
