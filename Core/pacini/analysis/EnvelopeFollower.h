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

/// Parameters of the envelope follower. Times are clamped to 0 s (immediate) to 1 h.
struct EnvelopeFollowerParams
{
    Seconds attack{0.001};
    Seconds hold{0.010};
    Seconds release{0.020};
    DecayDefinition decay = DecayDefinition::percent99;
    bool operator==(const EnvelopeFollowerParams&) const = default;
};

/// Smoothing coefficients of the envelope follower.
struct EnvelopeFollowerCoefficients
{
    double attack = 0.0;
    double release = 0.0;
    std::size_t holdFrames = 0;
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
    return {pole(params.attack), pole(params.release), roundedFrames(clamped(params.hold), fs)};
}

/// Envelope follower, M. Weber, "A Framework for Audio-Tactile Signal Translation", TU Berlin 2020, section 4.3.1 and
/// Algorithm 4.1 as reconstructed: y = c y + (1 - c)|x| with the attack's c while rising; falling, the envelope stands
/// for the hold, then releases. Rising is |x| >= y: the thesis's "discrete derivative", of which the pseudo-code is
/// lost, would follow every half wave, and with |x| > y the hold would run out on a plateau. The envelope lags behind
/// the signal by its attack, which latencyFrames() does not count: a follower is no delay.
class EnvelopeFollower : public DesignedBlock<EnvelopeFollower, EnvelopeFollowerParams>
{
public:
    void setParams(const Params& params) noexcept
    {
        current = params;
        coefficients = designEnvelopeFollower(params, fs);
    }
    void reset() noexcept { state = {}; }

    /// The envelope after one more sample (finite).
    double tick(double x) noexcept
    {
        const double level = std::abs(x);
        if (level >= state.envelope)
        {
            state.envelope = coefficients.attack * state.envelope + (1.0 - coefficients.attack) * level;
            state.held = coefficients.holdFrames;
        }
        else if (state.held > 0)
            --state.held;
        else
            state.envelope = coefficients.release * state.envelope + (1.0 - coefficients.release) * level;
        return state.envelope;
    }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        forEachSample(
            in, out, [this](double x) { return tick(x); }, [this] { flush(); });
    }

    /// For callers of tick(): to be called now and then, as process() does (see flushTiny).
    void flush() noexcept { flushTiny(state.envelope); }

private:
    struct State
    {
        double envelope = 0.0;
        std::size_t held = 0;
    };

    EnvelopeFollowerCoefficients coefficients;
    State state;
};

static_assert(DspBlock<EnvelopeFollower>);

} // namespace pacini
