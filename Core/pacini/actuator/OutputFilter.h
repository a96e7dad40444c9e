#pragma once

// Output filter that flattens an actuator: its measured equalizer, or the inverse of its resonance.

#include <pacini/actuator/BodyChain.h>
#include <pacini/actuator/Equalizer.h>
#include <pacini/actuator/PoleGroups.h>
#include <pacini/actuator/Profile.h>
#include <pacini/filters/Biquad.h>
#include <pacini/filters/BiquadCascade.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace pacini
{

/// The pole pair of a resonance: s^2 + w s / q + w^2.
[[nodiscard]] inline PoleGroup polePairOf(const Resonance& resonance) noexcept
{
    const double w = 2.0 * std::numbers::pi * clampTo(resonance.frequency, 0.1, 1e5);
    const double decay = 0.5 * w / clampTo(resonance.q, 1e-3, 1e4);
    return {-decay, (decay - w) * (decay + w)};
}

/// (s^2 + w0 s / q0 + w0^2) / (s^2 + w1 s / q1 + w1^2) at `fs` Hz with w0, q0 of `actuator` and w1, q1 of `target`: the
/// actuator then answers as if it had the target's resonance. Stable for every target; all numbers are clamped (0.1 Hz
/// to 100 kHz, q 1e-3 to 1e4). The gain far above both resonances is 1, below both (w0 / w1)^2: a lower target needs
/// more force there.
/// Zeros and poles are at exp(p / fs), as the poles of the body model are, so that the zeros cancel those exactly; a
/// bilinear design would leave a sharp pair of peak and notch. The gain at 0 Hz is exact.
[[nodiscard]] inline BiquadCoefficients designPolePairInverse(const Resonance& actuator, const Resonance& target,
                                                              double fs) noexcept
{
    struct Factor
    {
        double z1 = 0.0, z2 = 0.0, atOne = 0.0; ///< 1 + z1 z^-1 + z2 z^-2 and its value at z = 1
    };
    const auto factor = [fs](const Resonance& resonance)
    {
        const PoleGroup pair = polePairOf(resonance).perFrame(1.0 / fs);
        const double decay = std::exp(pair.centre);
        const double root = std::sqrt(std::abs(pair.spread));
        if (pair.spread < 0.0)
        {
            const double half = std::sin(0.5 * root);
            const double rest = std::expm1(pair.centre);
            return Factor{-2.0 * decay * std::cos(root), decay * decay, rest * rest + 4.0 * decay * half * half};
        }
        const double fast = pair.centre - root;
        const double w = 2.0 * std::numbers::pi * clampTo(resonance.frequency, 0.1, 1e5) / fs;
        const double slow = w * w / fast; // centre + root would cancel
        return Factor{-std::exp(slow) - std::exp(fast), decay * decay, std::expm1(slow) * std::expm1(fast)};
    };
    const Factor zeros = factor(actuator);
    const Factor poles = factor(target);
    const double ratio = clampTo(actuator.frequency, 0.1, 1e5) / clampTo(target.frequency, 0.1, 1e5);
    const double gain = ratio * ratio * poles.atOne / zeros.atOne;
    return {gain, gain * zeros.z1, gain * zeros.z2, poles.z1, poles.z2};
}

/// Returns the resonance of the moving mass with the device on the skin, where its base is not held still: of the whole
/// chain, the pole pair closest to that of two free masses on the suspension's spring. This is the pair to invert for a
/// wearer.
[[nodiscard]] inline Resonance loadedResonance(const BodyParams& body, const Resonance& resonance) noexcept
{
    const BodyChain chain = makeBodyChain(body, resonance);
    const double together = chain.deviceMass + chain.skinMass;
    const double free = std::sqrt(chain.suspensionStiffness / chain.movingMass * (1.0 + chain.movingMass / together));
    const auto frequency = [](const PoleGroup& pair)
    {
        return std::sqrt(std::max(pair.centre * pair.centre - pair.spread, 1e-300));
    };
    const PoleGroupList pairs = findPoleGroups(chain.denominator(RealPolynomial::identity()));
    const PoleGroup nearest =
        *std::min_element(pairs.begin(), pairs.end(),
                          [&](const PoleGroup& x, const PoleGroup& y) {
                              return std::abs(std::log(frequency(x) / free)) < std::abs(std::log(frequency(y) / free));
                          });
    const double w = frequency(nearest);
    return {w / (2.0 * std::numbers::pi), w / std::max(-2.0 * nearest.centre, 1e-300)};
}

/// Resonance correction. Trades strength at the resonance for the frequencies around it.
struct Flattening
{
    Resonance actuator;   ///< as it is worn
    Resonance target;     ///< what it answers like instead
    double gain = 1.0;    ///< headroom for what the inverse raises
    double most = 1e6;    ///< that any frequency is raised, inverse and gain together
    double octaves = 0.0; ///< by which the range grows at either end
    bool operator==(const Flattening&) const = default;
};

namespace detail
{
/// The frequencies at which the inverse of polePairOf(actuator) towards `target` may have its highest gain, Hz. With
/// x = (w / w0)^2 and r = (w1 / w0)^2 the gain's square is
///
///     N / D = (x^2 + (1 / q0^2 - 2) x + 1) / (x^2 + r (1 / q1^2 - 2) x + r^2),
///
/// whose slope has the sign of a quadratic in x (N' D - N D', where the cubes cancel): the highest gain is at one of
/// its two roots, at 0 (1 / r) or far above both resonances (1). 0 stands for a root that is none.
inline std::array<double, 2> turningPoints(const Resonance& actuator, const Resonance& target) noexcept
{
    const double r = target.frequency / actuator.frequency * (target.frequency / actuator.frequency);
    const double n = 1.0 / (actuator.q * actuator.q) - 2.0;
    const double d = r * (1.0 / (target.q * target.q) - 2.0);
    const double a = d - n;
    const double b = r * r - 1.0; // half of the coefficient of x
    const double c = n * r * r - d;
    const double root = std::sqrt(std::max(b * b - a * c, 0.0));
    const double larger = b < 0.0 ? root - b : -root - b; // no cancellation
    const auto frequency = [&](double above, double below)
    {
        const double x = below != 0.0 ? above / below : 0.0;
        return x > 0.0 ? actuator.frequency * std::sqrt(x) : 0.0;
    };
    return {frequency(larger, a), frequency(c, larger)};
}

/// The highest gain of the inverse at any frequency, without sampling.
inline double highestGain(const Resonance& actuator, const Resonance& target) noexcept
{
    const auto gain = [&](double frequency)
    {
        const auto size = [frequency](const Resonance& pair)
        {
            const double away = (pair.frequency - frequency) * (pair.frequency + frequency);
            return std::hypot(away, pair.frequency * frequency / pair.q);
        };
        return size(actuator) / size(target);
    };
    const auto [one, other] = turningPoints(actuator, target);
    return std::max({1.0, gain(0.0), gain(one), gain(other)});
}
} // namespace detail

/// The flattening of a valid profile whose drive is raised by at most `maxBoost` dB (0 to 40), or none: with an
/// equaliser of its own it is flat already, a motor has no resonance that a filter could undo, and nothing is known of
/// a plain signal.
/// Below its resonance a mass on a spring falls by 12 dB an octave, so that the boost moves the resonance down by
/// maxBoost / 12 octaves, with a q of 1 (of an eighth for very sharp ones, which would become too weak). The inverse
/// also starts and stops the mass sooner: it is the pre-emphasis and the active braking of slow actuators, exact for
/// the model. Half of the boost (in dB) is taken as headroom; the protection takes the rest where a sound needs all of
/// it.
/// That reckons with the gain at 0 Hz. At its new resonance a sharp actuator needs more, q1 (w0^2 / w1^2 - 1) for the
/// target's q1 and w1, and so does a damped one that is made sharper: where this would pass the bound the target stays
/// so much nearer to the actuator (on a straight line in octaves of both frequency and q) that it does not. A sharp one
/// keeps its strength that way, which a lower q1 would take. The way ends at a target of the same resonance and no more
/// sharpness, which raises nothing.
[[nodiscard]] inline std::optional<Flattening> flatteningOf(const Profile& profile, Decibels maxBoost) noexcept
{
    if (!profile.equalizer.empty() || profile.technology == Technology::erm || profile.technology == Technology::pcm ||
        !(maxBoost.value > 0.0))
        return std::nullopt;
    const double boost = std::min(maxBoost.value, 40.0);
    Flattening result;
    result.actuator = profile.body ? loadedResonance(*profile.body, profile.resonance) : profile.resonance;
    result.actuator.q = clampTo(result.actuator.q, 1e-3, 1e4);
    result.gain = Decibels(-0.5 * boost).gain();
    result.most = Decibels(boost).gain();
    const double wantedQ = std::max(1.0, result.actuator.q / 8.0);
    const double nearestQ = std::min(wantedQ, result.actuator.q);
    const auto aim = [&](double way)
    {
        result.octaves = way * boost / 12.0;
        result.target = {result.actuator.frequency * std::exp2(-result.octaves),
                         nearestQ * std::pow(wantedQ / nearestQ, way)};
        return result.gain * detail::highestGain(result.actuator, result.target) <= result.most;
    };
    double within = 0.0, beyond = 1.0;
    if (aim(beyond))
        return result;
    for (int i = 0; i < 40; ++i)
        (aim(0.5 * (within + beyond)) ? within : beyond) = 0.5 * (within + beyond);
    aim(within);
    return result;
}

namespace detail
{
/// The highest gain of the inverse of a flattening as designed at `fs` Hz: at the turning points of its model, or at
/// those that sampling made of them, where N and D are quadratics in sin^2(w / 2) (R. Bristow-Johnson's form).
inline double highestGain(const BiquadCoefficients& c, const Flattening& flattening, double fs) noexcept
{
    const auto section = asStateVariable(c);
    double highest = 0.0;
    const auto look = [&](double frequency)
    {
        if (frequency >= 0.0 && frequency <= 0.5 * fs)
            highest = std::max(highest, std::abs(section.response(Hertz(frequency), fs)));
    };
    look(0.0);
    look(0.5 * fs);
    for (const double frequency : turningPoints(flattening.actuator, flattening.target))
        look(frequency);
    const auto quadratic = [](double b0, double b1, double b2)
    {
        const double sum = b0 + b1 + b2;
        return std::array{sum * sum, -4.0 * (b0 * b1 + 4.0 * b0 * b2 + b1 * b2), 16.0 * b0 * b2};
    };
    const auto n = quadratic(c.b0, c.b1, c.b2);
    const auto d = quadratic(1.0, c.a1, c.a2);
    const double p = n[2] * d[1] - n[1] * d[2];
    const double q = n[2] * d[0] - n[0] * d[2]; // half of the coefficient
    const double s = n[1] * d[0] - n[0] * d[1];
    const double root = std::sqrt(std::max(q * q - p * s, 0.0));
    const double larger = q < 0.0 ? root - q : -root - q;
    for (const double x : {p != 0.0 ? larger / p : 0.0, larger != 0.0 ? s / larger : 0.0})
        if (x > 0.0 && x < 1.0)
            look(fs / std::numbers::pi * std::asin(std::sqrt(x)));
    return highest;
}
} // namespace detail

/// An optional equaliser and an optional resonance correction.
struct OutputFilterParams
{
    EqualizerSections equalizer;
    std::optional<Flattening> flattening;
    bool operator==(const OutputFilterParams&) const = default;
};

/// Equalizer and flattening in series at `fs` Hz. Resonances close to or above half the sample rate have other gains
/// than their model there. Any excess over the bound of the flattening is removed at all frequencies.
[[nodiscard]] inline BiquadCascadeCoefficients designOutputFilter(const OutputFilterParams& params, double fs) noexcept
{
    BiquadCascadeCoefficients cascade = designEqualizer(params.equalizer, fs);
    if (params.flattening)
    {
        BiquadCoefficients inverse = designPolePairInverse(params.flattening->actuator, params.flattening->target, fs);
        const double gain = params.flattening->gain;
        const double highest = detail::highestGain(inverse, *params.flattening, fs);
        const double within = gain * highest > params.flattening->most ? params.flattening->most / highest : gain;
        inverse.b0 *= within;
        inverse.b1 *= within;
        inverse.b2 *= within;
        cascade.sections.pushBack(asStateVariable(inverse));
    }
    return cascade;
}

using OutputFilter = DesignedCascade<OutputFilterParams, designOutputFilter>;

static_assert(DspBlock<OutputFilter>);

} // namespace pacini
