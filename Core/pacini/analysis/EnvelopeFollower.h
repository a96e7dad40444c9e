#pragma once

// The thesis's envelope follower: a one-pole smoother of |x| with separate attack and release, and a hold between them.

#include <pacini/analysis/DecayTime.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace pacini
{

/// Criterion for a rising signal. The thesis says "the discrete derivative" (section 4.3.1), and its pseudo-code is
/// lost.
enum class RisingSlope
{
    level,      ///< |x| >= envelope: the reading that gives an envelope
    strict,     ///< |x| > envelope: on a plateau the hold already runs out
    derivative, ///< |x| above the sample before: literal, but follows every half wave
};

/// Parameters of the envelope follower. Times are clamped to 0 s (immediate) to 1 h.
struct EnvelopeFollowerParams
{
    Seconds attack{0.001};
    Seconds hold{0.010};
    Seconds release{0.020};
    DecayDefinition decay = DecayDefinition::percent99;
    RisingSlope slope = RisingSlope::level;
    /// Attack and release become the longest times, and the crest factor of the signal shortens them.
    bool crestAdaptive = false;
    Seconds crestMemory{0.200}; ///< of the averages behind the crest factor
    bool operator==(const EnvelopeFollowerParams&) const = default;
};

/// Smoothing coefficients of the envelope follower.
struct EnvelopeFollowerCoefficients
{
    double attack = 0.0;
    double release = 0.0;
    std::size_t holdFrames = 0;
    double crestMemory = 0.0;         ///< pole of the averages behind the crest factor
    double longestAttackFrames = 0.0; ///< for the adaptive times, which are not rounded
    double longestReleaseFrames = 0.0;
    bool operator==(const EnvelopeFollowerCoefficients&) const = default;
};

[[nodiscard]] inline EnvelopeFollowerCoefficients designEnvelopeFollower(const EnvelopeFollowerParams& params,
                                                                         double fs) noexcept
{
    const auto clamped = [](Seconds time)
    {
        return Seconds(clampTo(time.value, 0.0, 3600.0));
    };
    const auto pole = [&](Seconds time)
    {
        return decayCoefficient(static_cast<double>(roundedFrames(clamped(time), fs)), params.decay);
    };
    return {pole(params.attack),
            pole(params.release),
            roundedFrames(clamped(params.hold), fs),
            decayCoefficient(clamped(params.crestMemory).frames(fs), DecayDefinition::percent63),
            clamped(params.attack).frames(fs),
            clamped(params.release).frames(fs)};
}

/// Envelope follower, M. Weber, "A Framework for Audio-Tactile Signal Translation", TU Berlin 2020, section 4.3.1 and
/// Algorithm 4.1 as reconstructed: y = c y + (1 - c)|x| with the attack's c while rising; falling, the envelope stands
/// for the hold, then releases. Adaptive times after D. Giannoulis, M. Massberg and J. D. Reiss, "Parameter automation
/// in a dynamic range compressor", JAES 61 (2013).
/// The envelope lags behind the signal by its attack, which latencyFrames() does not count: a follower is no delay.
class EnvelopeFollower : public DesignedBlock<EnvelopeFollower, EnvelopeFollowerParams>
{
public:
    void setParams(const Params& params) noexcept
    {
        current = params;
        fixed = designEnvelopeFollower(params, fs);
        moving = fixed;
    }
    void reset() noexcept { state = {}; }

    /// The envelope after one more sample (finite).
    double tick(double x) noexcept
    {
        const double level = std::abs(x);
        if (current.crestAdaptive)
            adaptTimes(level * level);
        if (rising(level))
        {
            state.envelope = moving.attack * state.envelope + (1.0 - moving.attack) * level;
            state.held = moving.holdFrames;
        }
        else if (state.held > 0)
            --state.held;
        else
            state.envelope = moving.release * state.envelope + (1.0 - moving.release) * level;
        state.level = level;
        return state.envelope;
    }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        forEachSample(
            in, out, [this](double x) { return tick(x); }, [this] { flush(); });
    }

    /// For callers of tick(): to be called now and then, as process() does (see flushTiny).
    void flush() noexcept
    {
        flushTiny(state.envelope);
        flushTiny(state.peakSquared);
        flushTiny(state.meanSquare);
    }

private:
    struct State
    {
        double envelope = 0.0;
        double level = 0.0;
        std::size_t held = 0;
        double peakSquared = 0.0;
        double meanSquare = 0.0;
    };

    [[nodiscard]] bool rising(double level) const noexcept
    {
        switch (current.slope)
        {
        case RisingSlope::level:
            return level >= state.envelope;
        case RisingSlope::strict:
            return level > state.envelope;
        case RisingSlope::derivative:
            return level > state.level;
        }
        return false;
    }

    /// Steady sounds (squared crest factor 2 for a sine) get the longest times, peaky ones shorter.
    void adaptTimes(double squared) noexcept
    {
        const double memory = fixed.crestMemory;
        state.peakSquared = std::max(squared, memory * state.peakSquared + (1.0 - memory) * squared);
        state.meanSquare = memory * state.meanSquare + (1.0 - memory) * squared;
        const double crestSquared = state.meanSquare > 1e-20 ? state.peakSquared / state.meanSquare : 2.0;
        const double attackFrames = 2.0 * fixed.longestAttackFrames / crestSquared;
        const double releaseFrames = std::max(2.0 * fixed.longestReleaseFrames / crestSquared - attackFrames, 0.0);
        moving.attack = decayCoefficient(attackFrames, current.decay);
        moving.release = decayCoefficient(releaseFrames, current.decay);
    }

    EnvelopeFollowerCoefficients fixed;
    EnvelopeFollowerCoefficients moving;
    State state;
};

static_assert(DspBlock<EnvelopeFollower>);

} // namespace pacini
