#pragma once

// Keeps the heat in an actuator's coil below what it bears.

#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>

#include <algorithm>
#include <cmath>

namespace pacini
{

/// Powers in W, clamped to 1e-12 to 1e12.
struct CoilHeatParams
{
    double fullDrivePower = 1.0; ///< W while the drive stands at 1
    double maxPower = 1.0;       ///< W that the coil bears for ever
    double thermalTime = 1.0;    ///< s, time constant of its heating, 0.01 to 10000
    bool operator==(const CoilHeatParams&) const = default;
};

/// The coil as one thermal mass: its temperature, given as the constant power that would hold it there, follows the
/// power as a one-pole filter and starts cold. It may never exceed maxPower.
///
/// Two parts act. The wanted power, averaged over about 0.1 s so that a gain does not follow the waveform, is compared
/// with an allowance that falls with the temperature, from five times the aimed-at power when cold (bursts pass) to
/// once when warm: the temperature then approaches the aim from below and never passes it. What averaging leaves (fast
/// coils, sudden peaks on a warm coil) a bound on the single sample takes away; the aim lies 5 % below the limit, so
/// that it hardly ever has to.
class CoilHeat
{
public:
    void design(const CoilHeatParams& params, double fs) noexcept
    {
        constexpr double averagingTime = 0.05; // s, twice one after the other
        full = clampTo(params.fullDrivePower, 1e-12, 1e12);
        limit = clampTo(params.maxPower, 1e-12, 1e12) * (1.0 - 1e-9); // and rounding
        heating = -std::expm1(-1.0 / (clampTo(params.thermalTime, 0.01, 1e4) * fs));
        averaging = -std::expm1(-1.0 / (averagingTime * fs));
    }
    void reset() noexcept { temperature = average1 = average2 = 0.0; }

    /// Follows the power as it is wanted and returns it over what is allowed now: what the square of a gain must undo.
    double measure(double wanted) noexcept
    {
        average1 += averaging * (full * wanted * wanted - average1);
        average2 += averaging * (average1 - average2);
        const double aim = 0.95 * limit;
        const double allowed = aim + 4.0 * std::max(0.0, aim - temperature);
        return average2 / allowed;
    }

    /// The drive nearest to `wanted` that keeps the temperature within the limit: a drive of sqrt(maxPower /
    /// fullDrivePower) always does.
    [[nodiscard]] double admit(double wanted) const noexcept
    {
        const double power = (limit - temperature) / heating + temperature;
        const double most = std::sqrt(std::max(power, 0.0) / full);
        return clampTo(wanted, -most, most);
    }

    void advance(double drive) noexcept { temperature += heating * (full * drive * drive - temperature); }

    void flush() noexcept
    {
        flushTiny(temperature);
        flushTiny(average1);
        flushTiny(average2);
    }

private:
    double full = 1.0;
    double limit = 1.0;
    double heating = 1.0;
    double averaging = 1.0;
    double temperature = 0.0;
    double average1 = 0.0;
    double average2 = 0.0;
};

} // namespace pacini
