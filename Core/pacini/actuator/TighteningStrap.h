#pragma once

// Simulated wearer who tightens the strap of a device while it plays.

#include <pacini/actuator/BodyModel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Parameters of a strap that is tightened.
struct TighteningStrapParams
{
    BodyParams loose;
    BodyParams tight;
    Resonance resonance;      ///< of the actuator when the strap is loose
    Resonance tightResonance; ///< and when it is tight
    BodyPoint point = BodyPoint::device;
    double start = 20.0; ///< s from which on the strap is tightened
    double length = 5.0; ///< s that this takes
    bool operator==(const TighteningStrapParams&) const = default;
};

/// `body` under a strap that is `factor` times as tight (0.1 to 10): the skin is as many times as stiff and as damped,
/// and as much of the arm moves with it. Assumed: straps of measured people are not in it.
[[nodiscard]] inline BodyParams tightened(BodyParams body, double factor) noexcept
{
    body.skinStiffness *= factor;
    body.skinDamping *= factor;
    body.skinMass *= factor;
    return body;
}

/// Drive in, acceleration in m/s^2 out: the loose device, then the tight one, with a linear change from one to the
/// other.
class TighteningStrap
{
public:
    using Params = TighteningStrapParams;

    void setParams(const Params& params) noexcept
    {
        current = params;
        loose.setParams({params.loose, params.resonance, params.point, BodyForce::coil, Decibels(-300.0)});
        tight.setParams({params.tight, params.tightResonance, params.point, BodyForce::coil, Decibels(-300.0)});
    }
    void prepare(const ProcessSpec& spec)
    {
        fs = spec.sampleRate;
        loose.prepare(spec);
        tight.prepare(spec);
        other.assign(spec.maxBlockFrames, 0.0f);
        reset();
    }
    void reset() noexcept
    {
        loose.reset();
        tight.reset();
        frame = 0;
    }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        const auto second = std::span(other).first(in.size());
        tight.process(in, second);
        loose.process(in, out);
        for (std::size_t i = 0; i < in.size(); ++i, ++frame)
        {
            const double seconds = static_cast<double>(frame) / fs - current.start;
            const double share = std::clamp(seconds / std::max(current.length, 1e-9), 0.0, 1.0);
            out[i] = toSample((1.0 - share) * static_cast<double>(out[i]) + share * static_cast<double>(second[i]));
        }
    }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return loose.latencyFrames(); }

private:
    Params current;
    BodyModel loose;
    BodyModel tight;
    std::vector<float> other;
    std::size_t frame = 0;
    double fs = ProcessSpec{}.sampleRate;
};

static_assert(DspBlock<TighteningStrap>);

/// The level of a drive of 1 at f Hz, dB re 1 m/s^2, before and after the strap was tightened.
[[nodiscard]] inline double strapLevel(const TighteningStrapParams& params, double f, bool tight)
{
    const auto response = bodyFrequencyResponse(
        tight ? params.tight : params.loose, tight ? params.tightResonance : params.resonance, Hertz(f), params.point);
    return Decibels::fromGain(std::abs(response)).value;
}

} // namespace pacini
