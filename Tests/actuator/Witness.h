#pragma once

// What a drive signal does to an actuator, by an integration of its own.

#include "actuator/SimulatedActuator.h"

#include <pacini/actuator/Profile.h>
#include <pacini/actuator/ProtectionParams.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace pacini::test
{

/// The mass of SimulatedResonator by the textbook solution of the damped oscillation between the frames (sine and
/// cosine, or two decays), in long double: some ten times as fast. It looks at points 0.05 rad apart, between which a
/// swing passes them by 0.03 %.
class SwingingMass
{
public:
    SwingingMass(double frequency, double q, double staticExcursion, double fs)
        : w0(2.0L * std::numbers::pi_v<long double> * frequency), excursion(staticExcursion)
    {
        const long double step = w0 / fs;
        points = std::max(1, static_cast<int>(std::ceil(step / 0.05L)));
        const long double angle = step / points;
        const long double zeta = 0.5L / q;
        const long double root = std::sqrt(std::abs(1.0L - zeta * zeta));
        const long double decay = std::exp(-zeta * angle);
        // Critical damping itself is met by none of the random actuators.
        const bool swings = zeta < 1.0L;
        const long double c = decay * (swings ? std::cos(root * angle) : std::cosh(root * angle));
        const long double s = decay * (swings ? std::sin(root * angle) : std::sinh(root * angle)) / root;
        xx = c + zeta * s;
        xv = s;
        vx = -s;
        vv = c - zeta * s;
    }

    void hold(double drive)
    {
        const long double rest = excursion * drive;
        for (int i = 0; i < points; ++i)
        {
            const long double away = x - rest;
            x = rest + xx * away + xv * v;
            v = vx * away + vv * v;
            largest = std::max(largest, std::abs(x));
        }
    }

    [[nodiscard]] double displacement() const { return static_cast<double>(x); }
    [[nodiscard]] double velocity() const { return static_cast<double>(w0 * v); }
    [[nodiscard]] double peak() const { return static_cast<double>(largest); }

private:
    long double w0;
    long double excursion;
    int points = 1;
    long double xx = 1, xv = 0, vx = 0, vv = 1;
    long double x = 0;
    long double v = 0; // over w0
    long double largest = 0;
};

/// The mass of SimulatedBody by steps of the matrix exponential (a Taylor series, then squared), in double: some ten
/// times as fast. It looks at points 0.1 rad apart of the fastest mode.
class SwingingBody
{
public:
    SwingingBody(const WornChain& chain, double fs)
    {
        points = std::max(1, static_cast<int>(std::ceil(chain.fastest() / (0.1L * fs))));
        constexpr int halvings = 6;
        const long double h = 1.0L / (fs * points * (1 << halvings));
        // Column by column: a unit of each state, and of the drive.
        std::array<std::array<long double, 7>, 7> step{};
        for (std::size_t j = 0; j < 7; ++j)
        {
            WornChain::State term{}, sum{};
            if (j < 6)
                term[j] = sum[j] = 1;
            for (int n = 1; n <= 12; ++n)
            {
                term = chain.slope(term, n == 1 && j == 6 ? 1 : 0);
                for (std::size_t i = 0; i < 6; ++i)
                    sum[i] += term[i] *= h / n;
            }
            for (std::size_t i = 0; i < 6; ++i)
                step[i][j] = sum[i];
        }
        step[6][6] = 1;
        for (int n = 0; n < halvings; ++n)
        {
            const auto half = step;
            for (std::size_t i = 0; i < 7; ++i)
                for (std::size_t j = 0; j < 7; ++j)
                {
                    step[i][j] = 0;
                    for (std::size_t l = 0; l < 7; ++l)
                        step[i][j] += half[i][l] * half[l][j];
                }
        }
        for (std::size_t j = 0; j < 7; ++j)
            for (std::size_t i = 0; i < 6; ++i)
                columns[j][i] = static_cast<double>(step[i][j]);
    }

    void hold(double drive)
    {
        for (int n = 0; n < points; ++n)
        {
            std::array<double, 6> next{};
            for (std::size_t j = 0; j < 7; ++j)
                for (std::size_t i = 0; i < 6; ++i)
                    next[i] += columns[j][i] * (j < 6 ? z[j] : drive);
            z = next;
            largest = std::max(largest, std::abs(z[0]));
        }
    }

    [[nodiscard]] double displacement() const { return z[0]; }
    [[nodiscard]] double velocity() const { return z[3]; }
    [[nodiscard]] double peak() const { return largest; }

private:
    int points = 1;
    std::array<std::array<double, 6>, 7> columns{};
    std::array<double, 6> z{};
    double largest = 0.0;
};

/// The mass as it is worn that goes with the mass on a base held still.
template <typename Mass>
struct WornMass;
template <>
struct WornMass<SimulatedResonator>
{
    using Type = SimulatedBody;
};
template <>
struct WornMass<SwingingMass>
{
    using Type = SwingingBody;
};

/// Gives a profile with a resonance a random body: devices from lighter than the moving mass to a hundred times as
/// heavy, joints that swing at a third to ten times the resonance, skins that hold the whole at a fiftieth to twice the
/// resonance, or not at all.
inline void wear(Profile& profile, Random& random)
{
    const auto wide = [&](double low, double high)
    {
        return low * std::pow(high / low, random.uniform());
    };
    const double w0 = 2.0 * std::numbers::pi * profile.resonance.frequency;
    const auto link = [&](double mass, double low, double high, double& stiffness, double& damping)
    {
        const double w = w0 * wide(low, high);
        stiffness = mass * w * w;
        damping = mass * w / wide(0.3, 50.0);
    };
    BodyParams& body = profile.body.emplace();
    body.movingMass = wide(1e-3, 0.1);
    body.deviceMass = body.movingMass * wide(0.5, 100.0);
    body.skinMass = body.movingMass * wide(0.2, 20.0);
    const double apart = body.deviceMass * body.skinMass / (body.deviceMass + body.skinMass);
    link(apart, 0.3, 10.0, body.jointStiffness, body.jointDamping);
    body.jointStiffness = std::max(1.0, body.jointStiffness);
    link(body.movingMass + body.deviceMass + body.skinMass, 0.02, 2.0, body.skinStiffness, body.skinDamping);
    if (random.uniform() < 0.1)
        body.skinStiffness = body.skinDamping = 0.0;
}

/// What a drive did to an actuator, over its limits; 0 where it has none.
struct Strain
{
    double travel = 0.0;
    double worn = 0.0; ///< travel as the profile's body is worn
    double heat = 0.0;
    double level = 0.0; ///< the largest sample

    void add(const Strain& other)
    {
        travel = std::max(travel, other.travel);
        worn = std::max(worn, other.worn);
        heat = std::max(heat, other.heat);
        level = std::max(level, other.level);
    }
    /// The worst over its limit.
    [[nodiscard]] double worst() const { return std::max({travel, worn, heat}); }
};

/// The physics of a profile under the samples of its drive signal, of which 1 is `overdrive` times the rated drive.
/// What the guard keeps holds for the drive as it is rounded to float; 0.1 % covers the rounding of either side.
template <typename Mass>
class Witness
{
public:
    static constexpr double tolerance = 1.001;

    Witness(const Profile& profile, double fs)
        : limits(profile.drive),
          mass(profile.resonance.frequency, profile.resonance.q, limits.overdrive * limits.excursion.value_or(0.0), fs),
          // A motor has a direct voltage, all others the peaks of a sinusoid.
          fullPower(limits.overdrive * limits.overdrive * (profile.technology == Technology::erm ? 1.0 : 2.0) *
                    limits.maxVoltageRms.value_or(0.0) * limits.maxVoltageRms.value_or(0.0) /
                    limits.impedance.value_or(1.0)),
          cooling(std::exp(-1.0 / (limits.thermalTime.value_or(defaultThermalTime) * fs)))
    {
        // The mass of a motor turns with the device.
        if (profile.body && limits.maxExcursion && profile.technology != Technology::erm)
            worn.emplace_back(
                WornChain(*profile.body, profile.resonance, static_cast<double>(WornChain::forceOf(profile))), fs);
    }

    void hold(float sample)
    {
        const auto drive = static_cast<double>(sample);
        level = std::max(level, std::abs(drive));
        mass.hold(drive);
        for (auto& swinging : worn)
            swinging.hold(drive);
        const double power = fullPower * drive * drive;
        temperature = power + (temperature - power) * cooling;
        hottest = std::max(hottest, temperature);
    }
    void hold(std::span<const float> drive)
    {
        for (const float sample : drive)
            hold(sample);
    }

    [[nodiscard]] const Mass& moving() const { return mass; }
    /// Null without a body, or a limit.
    [[nodiscard]] const auto* movingAsWorn() const { return worn.empty() ? nullptr : &worn.front(); }
    [[nodiscard]] Strain strain() const
    {
        return {limits.maxExcursion ? mass.peak() / *limits.maxExcursion : 0.0,
                worn.empty() ? 0.0 : worn.front().peak() / *limits.maxExcursion,
                limits.maxPower ? hottest / *limits.maxPower : 0.0, level};
    }

private:
    ActuatorDrive limits;
    Mass mass;
    std::vector<typename WornMass<Mass>::Type> worn; ///< one or none
    double fullPower, cooling;
    double temperature = 0.0, hottest = 0.0, level = 0.0;
};

} // namespace pacini::test
