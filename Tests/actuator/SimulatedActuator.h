#pragma once

// Actuators as differential equations, integrated finely in long double: unlike the exact steps of the code under test.

#include <algorithm>
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
