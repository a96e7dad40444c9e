#pragma once

// Actuators as differential equations, integrated finely in long double: unlike the exact steps of the code under test.

#include <pacini/actuator/Profile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace pacini::test
{

/// x'' + (w0/q) x' + w0^2 x = w0^2 excursion u with the drive held over each sample; classical Runge-Kutta.
class SimulatedResonator
{
public:
    SimulatedResonator(double frequency, double q, double staticExcursion, double fs)
        : w0(2.0L * std::numbers::pi_v<long double> * frequency),
          damping(w0 / q),
          excursion(staticExcursion),
          duration(1.0L / fs),
          substeps(std::max(16, static_cast<int>(40.0 * frequency / fs)))
    {
    }

    void hold(double drive)
    {
        const long double h = duration / substeps;
        const long double rest = excursion * drive;
        const auto acceleration = [&](long double position, long double speed)
        {
            return w0 * w0 * (rest - position) - damping * speed;
        };
        for (int i = 0; i < substeps; ++i)
        {
            const long double a1 = acceleration(x, v);
            const long double v2 = v + h / 2 * a1;
            const long double a2 = acceleration(x + h / 2 * v, v2);
            const long double v3 = v + h / 2 * a2;
            const long double a3 = acceleration(x + h / 2 * v2, v3);
            const long double v4 = v + h * a3;
            const long double a4 = acceleration(x + h * v3, v4);
            x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
            v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
            largest = std::max(largest, std::abs(x));
        }
    }

    /// m
    [[nodiscard]] double displacement() const { return static_cast<double>(x); }
    [[nodiscard]] double velocity() const { return static_cast<double>(v); }
    /// The largest displacement so far, m.
    [[nodiscard]] double peak() const { return static_cast<double>(largest); }
    /// The amplitude at which the mass would ring on without damping, m.
    [[nodiscard]] double amplitude() const { return static_cast<double>(std::sqrt(x * x + v * v / (w0 * w0))); }

private:
    long double w0;
    long double damping;
    long double excursion;
    long double duration;
    int substeps;
    long double x = 0;
    long double v = 0;
    long double largest = 0;
};

/// Newton's law for the chain of a profile's body: the moving mass on its suspension in the device, the device on its
/// joint to the skin, the skin on the ground.
struct WornChain
{
    using Real = long double;
    /// Travel of the mass against the device, device against skin and skin against ground, m, and their rates, m/s.
    using State = std::array<Real, 6>;

    WornChain(const BodyParams& params, const Resonance& resonance, double forceAtOne)
        : body(params),
          force(forceAtOne),
          k(suspension(params, resonance)),
          c(2 * std::numbers::pi_v<Real> * resonance.frequency * params.movingMass / resonance.q)
    {
    }

    static Real suspension(const BodyParams& body, const Resonance& resonance)
    {
        const Real w0 = 2 * std::numbers::pi_v<Real> * resonance.frequency;
        return w0 * w0 * body.movingMass;
    }
    /// The force that gives the stated travel with the base held still, or that of the body if it is larger.
    static Real forceOf(const Profile& profile)
    {
        const Real stated = suspension(*profile.body, profile.resonance) * profile.drive.excursion.value_or(0.0);
        return profile.drive.overdrive * std::max(stated, static_cast<Real>(profile.body->force));
    }

    [[nodiscard]] State slope(const State& z, Real drive) const
    {
        const Real coil = force * drive - k * z[0] - c * z[3]; // on the mass; the device bears the opposite
        const Real joint = body.jointStiffness * z[1] + body.jointDamping * z[4];
        const Real skin = body.skinStiffness * z[2] + body.skinDamping * z[5];
        const Real device = (-coil - joint) / body.deviceMass;
        const Real ground = (joint - skin) / body.skinMass;
        return {z[3], z[4], z[5], coil / body.movingMass - device, device - ground, ground};
    }
    /// A bound on the angular frequencies of all modes, Hz times 2 pi: by Gershgorin's circles of the stiffnesses over
    /// the masses, with the dampers over the masses.
    [[nodiscard]] Real fastest() const
    {
        const auto bound = [this](Real coilLink, Real jointLink, Real skinLink)
        {
            return std::max({2 * coilLink / body.movingMass, 2 * (coilLink + jointLink) / body.deviceMass,
                             (2 * jointLink + skinLink) / body.skinMass});
        };
        return std::sqrt(bound(k, body.jointStiffness, body.skinStiffness)) +
               bound(c, body.jointDamping, body.skinDamping);
    }

    BodyParams body;
    Real force, k, c;
};

/// The moving mass of an actuator as it is worn; classical Runge-Kutta.
class SimulatedBody
{
public:
    SimulatedBody(const WornChain& worn, double fs) : chain(worn), duration(1.0L / fs)
    {
        substeps = std::max(8, static_cast<int>(std::ceil(chain.fastest() * duration / 0.2L)));
    }

    void hold(double drive)
    {
        const auto h = duration / substeps;
        const auto moved = [](WornChain::State x, WornChain::Real by, const WornChain::State& slope)
        {
            for (std::size_t i = 0; i < x.size(); ++i)
                x[i] += by * slope[i];
            return x;
        };
        for (int i = 0; i < substeps; ++i)
        {
            const auto k1 = chain.slope(z, drive);
            const auto k2 = chain.slope(moved(z, h / 2, k1), drive);
            const auto k3 = chain.slope(moved(z, h / 2, k2), drive);
            const auto k4 = chain.slope(moved(z, h, k3), drive);
            for (std::size_t j = 0; j < z.size(); ++j)
                z[j] += h / 6 * (k1[j] + 2 * (k2[j] + k3[j]) + k4[j]);
            largest = std::max(largest, std::abs(z[0]));
        }
    }

    [[nodiscard]] double displacement() const { return static_cast<double>(z[0]); }
    [[nodiscard]] double velocity() const { return static_cast<double>(z[3]); }
    [[nodiscard]] double peak() const { return static_cast<double>(largest); }

private:
    WornChain chain;
    long double duration;
    int substeps = 1;
    WornChain::State z{};
    long double largest = 0;
};

/// The highest temperature, in watts of constant power that would hold it, of a coil that starts cold.
inline double hottest(std::span<const float> drive, double fullDrivePower, double thermalTime, double fs)
{
    const long double keep = std::exp(-1.0L / (static_cast<long double>(thermalTime) * fs));
    long double temperature = 0;
    long double highest = 0;
    for (const float u : drive)
    {
        const long double power = static_cast<long double>(fullDrivePower) * u * u;
        temperature = power + (temperature - power) * keep;
        highest = std::max(highest, temperature);
    }
    return static_cast<double>(highest);
}

} // namespace pacini::test
