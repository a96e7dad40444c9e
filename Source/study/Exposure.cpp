#include "study/Exposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pacini::study
{

namespace
{
// Table A.1 of ISO 5349-1: corners of the band in Hz with their Q, and of the transition from acceleration to velocity.
constexpr double f1 = 6.310, f2 = 1258.9, q1 = 0.71, f3 = 15.915, f4 = 15.915, q2 = 0.64;
constexpr double turn = 2.0 * std::numbers::pi;
constexpr double workday = 8.0 * 3600.0; // s

/// A section of second order in transposed direct form II; state and coefficients in double.
struct Section
{
    double b0, b1, b2, a1, a2;
    double z1 = 0.0, z2 = 0.0;

    double operator()(double x) noexcept
    {
        const double y = b0 * x + z1;
        z1 = b1 * x - a1 * y + z2;
        z2 = b2 * x - a2 * y;
        return y;
    }
};

/// (n2 s^2 + n1 s + n0) / (s^2 + d1 s + d0) by the bilinear transform, which is exact at `exactAt` Hz.
Section bilinear(double n2, double n1, double n0, double d1, double d0, double exactAt, double sampleRate) noexcept
{
    const double w = turn * exactAt;
    const double c = w / std::tan(0.5 * w / sampleRate);
    const double scale = 1.0 / (c * c + d1 * c + d0);
    return {(n2 * c * c + n1 * c + n0) * scale, 2.0 * (n0 - n2 * c * c) * scale, (n2 * c * c - n1 * c + n0) * scale,
            2.0 * (d0 - c * c) * scale, (c * c - d1 * c + d0) * scale};
}
} // namespace

double dailyExposure(double dose) noexcept
{
    return std::sqrt(std::max(dose, 0.0) / workday);
}

double doseOf(std::span<const float> acceleration, double sampleRate)
{
    const double w1 = turn * f1, w2 = turn * f2, w3 = turn * f3, w4 = turn * f4;
    // Below the Nyquist frequency, where the transform has a place for it.
    const double top = std::min(f2, 0.4 * sampleRate);
    std::array<Section, 3> sections{bilinear(1.0, 0.0, 0.0, w1 / q1, w1 * w1, f1, sampleRate),
                                    bilinear(0.0, 0.0, w2 * w2, w2 / q1, w2 * w2, top, sampleRate),
                                    bilinear(0.0, w4 * w4 / w3, w4 * w4, w4 / q2, w4 * w4, f4, sampleRate)};
    double sum = 0.0;
    for (const float sample : acceleration)
    {
        double x = std::isfinite(sample) ? static_cast<double>(sample) : 0.0;
        for (Section& section : sections)
            x = section(x);
        sum += x * x;
    }
    return sum / sampleRate;
}

} // namespace pacini::study
