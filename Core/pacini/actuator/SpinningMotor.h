#pragma once

// Model of a motor with an eccentric mass (ERM): drive signal -> force.

#include <pacini/actuator/Profile.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace pacini
{

/// Speed and response of a motor.
struct SpinningMotorParams
{
    Hertz frequency{180.0}; ///< turns per second at a drive of 1
    ActuatorResponse response;
    bool operator==(const SpinningMotorParams&) const = default;
};

/// Drive in, force out in units of the force at full speed, along one axis. The speed follows the voltage, sign
/// included, by a first-order lag: back-EMF and friction against inertia (as for any small DC motor). A quickly
/// alternating drive has no mean and hardly turns it. The mass m on radius r turned at w pulls with m r w^2, so the
/// force grows with the square of the speed, and its frequency with the speed.
///
/// Response times are of the strength, which is the square of the speed: it is at 90 % when the speed is at
/// sqrt(0.9), after -log(1 - sqrt(0.9)) = 2.97 time constants, and down to 10 % after log(10) / 2 = 1.15 of those of
/// the fall. The fall's hold while the voltage is less than the speed; against its direction the motor is driven.
class SpinningMotor : public DesignedBlock<SpinningMotor, SpinningMotorParams>
{
public:
    void setParams(const Params& params) noexcept
    {
        current = params;
        turnsPerFrame = clampTo(params.frequency.value, 0.1, 1e5) / fs;
        const auto share = [this](double time, double constants)
        {
            return -std::expm1(-constants / (clampTo(time, 0.0, 100.0) * fs));
        };
        rise = share(params.response.riseTime, -std::log1p(-std::sqrt(0.9)));
        fall = share(params.response.fallTime, 0.5 * std::numbers::ln10);
    }
    void reset() noexcept { speed = turn = 0.0; }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        const auto tick = [this](double drive)
        {
            constexpr double largest = 10.0; // the most that a profile's overdrive allows
            const double wanted = clampTo(drive, -largest, largest);
            const bool coasting = wanted * speed >= 0.0 && std::abs(wanted) < std::abs(speed);
            speed += (coasting ? fall : rise) * (wanted - speed);
            turn += speed * turnsPerFrame;
            turn -= std::floor(turn);
            return speed * speed * std::sin(2.0 * std::numbers::pi * turn);
        };
        forEachSample(in, out, tick, [this] { flushTiny(speed); });
    }

private:
    double turnsPerFrame = 0.0;
    double rise = 1.0; ///< share of the way to the wanted speed in one frame
    double fall = 1.0;
    double speed = 0.0; ///< 1 at a constant drive of 1
    double turn = 0.0;  ///< 0 to 1
};

static_assert(DspBlock<SpinningMotor>);

} // namespace pacini
