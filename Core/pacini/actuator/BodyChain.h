#pragma once

// Mechanical model of actuator, device and skin as a chain of masses, springs and dampers, with its frequency response.

#include <pacini/actuator/Profile.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Units.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace pacini
{

/// The frequencies that skin feels: there a body's filter is fitted and its simplifications are judged.
struct BodyBand
{
    static constexpr double lowest = 30.0;    ///< Hz
    static constexpr double highest = 1000.0; ///< Hz
};

/// Output of the body model: the observed quantity.
enum class BodyPoint
{
    movingMass, ///< acceleration, m/s^2
    device,     ///< acceleration, m/s^2, as an accelerometer on the case measures it
    skin,       ///< acceleration of the skin, m/s^2
    excursion   ///< of the moving mass from rest against the device, m
};

/// Model order: the parts of the chain that are kept.
enum class BodyShape
{
    elastic, ///< everything
    rigid,   ///< device and skin are one mass
    skinless ///< the device moves freely, and the skin with it
};

/// Input of the body model: where the force acts.
enum class BodyForce
{
    coil,  ///< between moving mass and device
    device ///< on the device from outside, such as by a spinning mass; the moving mass is part of the device
};

/// Moving mass - spring, damper - device - joint - skin - spring, damper - ground (M. Weber, "A Framework for
/// Audio-Tactile Signal Translation", 2020, Fig. 3.2). The force is + on the moving mass and - on the device.
///
/// With z0, J and T the mechanical impedances times s of suspension, joint and skin, T with the skin's mass, Cramer's
/// rule on the equations of motion gives the polynomials below. All terms of each have one sign, so coefficients have
/// full relative accuracy whatever the ratio of the springs; a state matrix loses the slow motion beside a stiff joint.
struct BodyChain
{
    double force = 0.0; ///< N at a drive of 1
    double movingMass = 0.0, suspensionStiffness = 0.0, suspensionDamping = 0.0;
    double deviceMass = 0.0, jointStiffness = 0.0, jointDamping = 0.0;
    double skinMass = 0.0, skinStiffness = 0.0, skinDamping = 0.0;
    BodyShape shape = BodyShape::elastic;
    BodyForce driven = BodyForce::coil;
    bool operator==(const BodyChain&) const = default;

    /// The denominator of every response, for s a complex number, a polynomial or a PairNumber. Its degree is even.
    template <typename S>
    [[nodiscard]] S denominator(const S& s) const noexcept
    {
        const S s2 = s * s;
        const double together = movingMass + deviceMass;
        if (driven == BodyForce::device)
            return shape == BodyShape::skinless ? 0.0 * s + together : together * s2 * coupling(s) + series(s);
        const S suspension = suspensionDamping * s + suspensionStiffness;
        const S free = movingMass * deviceMass * s2 + together * suspension;
        if (shape == BodyShape::skinless)
            return free;
        return s2 * free * coupling(s) + series(s) * (movingMass * s2 + suspension);
    }

    /// The numerator of the response of `point` to a force of 1 N.
    template <typename S>
    [[nodiscard]] S numerator(BodyPoint point, const S& s) const noexcept
    {
        const S s2 = s * s;
        // The skinless chain has no static force: s^2 is taken out above and below.
        const S inertia = shape == BodyShape::skinless ? 0.0 * s + 1.0 : s2;
        if (driven == BodyForce::device)
        {
            if (point == BodyPoint::excursion)
                return 0.0 * s;
            return inertia * (point == BodyPoint::skin ? joint(s) : coupling(s));
        }
        switch (point)
        {
        case BodyPoint::movingMass:
            return s2 * (deviceMass * inertia * coupling(s) + series(s));
        case BodyPoint::device:
            return -movingMass * s2 * inertia * coupling(s);
        case BodyPoint::skin:
            return -movingMass * s2 * inertia * joint(s);
        case BodyPoint::excursion:
            return (movingMass + deviceMass) * inertia * coupling(s) + series(s);
        }
        return s;
    }

    /// The response per unit of drive at s = 2 pi i f.
    [[nodiscard]] std::complex<double> response(BodyPoint point, Hertz f) const noexcept
    {
        const std::complex<double> s{0.0, 2.0 * std::numbers::pi * f.value};
        return force * numerator(point, s) / denominator(s);
    }

    /// The frequency at which device and skin swing against each other on the joint alone, without damping.
    [[nodiscard]] Hertz jointFrequency() const noexcept
    {
        const double reducedMass = deviceMass * skinMass / (deviceMass + skinMass);
        return Hertz(std::sqrt(jointStiffness / reducedMass) / (2.0 * std::numbers::pi));
    }

private:
    /// J, or 1 when the joint is rigid: everything is then divided by J.
    template <typename S>
    [[nodiscard]] S joint(const S& s) const noexcept
    {
        return shape == BodyShape::elastic ? jointDamping * s + jointStiffness : 0.0 * s + 1.0;
    }
    /// T
    template <typename S>
    [[nodiscard]] S skin(const S& s) const noexcept
    {
        return skinMass * (s * s) + (skinDamping * s + skinStiffness);
    }
    /// T + J
    template <typename S>
    [[nodiscard]] S coupling(const S& s) const noexcept
    {
        return shape == BodyShape::elastic ? skin(s) + joint(s) : joint(s);
    }
    /// T J
    template <typename S>
    [[nodiscard]] S series(const S& s) const noexcept
    {
        return shape == BodyShape::skinless ? 0.0 * s : skin(s) * joint(s);
    }
};

/// The whole chain of a profile's body and resonance; the suspension is that of the moving mass on a base held still:
/// stiffness m w^2, damping m w / q. Every number is clamped to what the arithmetic bears (masses 1e-9 to 1e3 kg,
/// stiffness to 1e14 N/m, damping to 1e10 N s/m, resonances 0.1 Hz to 100 kHz with q 1e-3 to 1e4), which is more than a
/// valid profile can hold. Skin that would let everything float below 0.01 Hz is held at 0.01 Hz: far below all that is
/// felt, and the denominator keeps its degree.
[[nodiscard]] inline BodyChain makeBodyChain(const BodyParams& body, const Resonance& resonance,
                                             BodyForce driven = BodyForce::coil) noexcept
{
    const auto mass = [](double m)
    {
        return clampTo(m, 1e-9, 1e3);
    };
    const auto stiffness = [](double k, double lowest)
    {
        return clampTo(k, lowest, 1e14);
    };
    const auto damping = [](double d)
    {
        return clampTo(d, 0.0, 1e10);
    };
    BodyChain chain;
    chain.force = clampTo(body.force, -1e6, 1e6);
    chain.movingMass = mass(body.movingMass);
    const double w = 2.0 * std::numbers::pi * clampTo(resonance.frequency, 0.1, 1e5);
    chain.suspensionStiffness = chain.movingMass * w * w;
    chain.suspensionDamping = chain.movingMass * w / clampTo(resonance.q, 1e-3, 1e4);
    chain.deviceMass = mass(body.deviceMass);
    chain.jointStiffness = stiffness(body.jointStiffness, 1e-3);
    chain.jointDamping = damping(body.jointDamping);
    chain.skinMass = mass(body.skinMass);
    const double slowest = 2.0 * std::numbers::pi * 0.01;
    chain.skinStiffness =
        stiffness(body.skinStiffness, (chain.movingMass + chain.deviceMass + chain.skinMass) * slowest * slowest);
    chain.skinDamping = damping(body.skinDamping);
    chain.driven = driven;
    return chain;
}

/// The continuous response of a body at `f` to a drive of 1, with everything kept: m/s^2, or m for the excursion.
[[nodiscard]] inline std::complex<double> bodyFrequencyResponse(const BodyParams& body, const Resonance& resonance,
                                                                Hertz f, BodyPoint point = BodyPoint::skin) noexcept
{
    return makeBodyChain(body, resonance).response(point, f);
}

} // namespace pacini
