#include "study/Exposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pacini::study
{

namespace
{
constexpr double turn = 2.0 * std::numbers::pi;
constexpr double workday = 8.0 * 3600.0; // s

/// Corners of the band in Hz with their Q, of the transition from acceleration to velocity, and of an upward step.
struct Weighting
{
    double low, high, bandQ;
    double transition, transitionQ;
    double stepFrom, stepTo, stepQ; // no step where both are equal
};

// ISO 5349-1, table A.1 (Wh), and ISO 2631-1, table A.1 (Wk).
constexpr Weighting handArm{6.310, 1258.9, 0.71, 15.915, 0.64, 1.0, 1.0, 1.0};
constexpr Weighting vertical{0.4, 100.0, 0.7071, 12.5, 0.63, 2.37, 3.35, 0.91};

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

double doseOf(std::span<const float> acceleration, double sampleRate, ExposedPart part)
{
    const Weighting& weighting = part == ExposedPart::hand ? handArm : vertical;
    const double low = turn * weighting.low, high = turn * weighting.high, transition = turn * weighting.transition;
    const double from = turn * weighting.stepFrom, to = turn * weighting.stepTo;
    // Below the Nyquist frequency, where the transform has a place for it.
    const double top = std::min(weighting.high, 0.4 * sampleRate);
    std::array<Section, 4> sections{
        bilinear(1.0, 0.0, 0.0, low / weighting.bandQ, low * low, weighting.low, sampleRate),
        bilinear(0.0, 0.0, high * high, high / weighting.bandQ, high * high, top, sampleRate),
        bilinear(0.0, transition, transition * transition, transition / weighting.transitionQ, transition * transition,
                 weighting.transition, sampleRate),
        bilinear(1.0, from / weighting.stepQ, from * from, to / weighting.stepQ, to * to, weighting.stepTo,
                 sampleRate)};
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
