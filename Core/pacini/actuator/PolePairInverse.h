#pragma once

// Inverse filter of a resonance: takes an actuator's pair of poles away.

#include <pacini/actuator/BodyChain.h>
#include <pacini/actuator/PoleGroups.h>
#include <pacini/filters/Biquad.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// The resonance of the moving mass when its base is not held still but is the device on the skin: the pair of the
/// whole chain that lies nearest to that of two free masses on the suspension's spring. This is the pair to invert for
/// a wearer.
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

} // namespace pacini
