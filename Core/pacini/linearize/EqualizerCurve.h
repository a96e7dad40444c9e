#pragma once

// Magnitude response of equalizer sections, and its derivatives by their parameters.

#include <pacini/actuator/Equalizer.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace pacini
{

/// The level of an equalizer in dB at `frequency` Hz when it runs at `fs` Hz: of designEqualizer(), so of what streams.
[[nodiscard]] inline double equalizerLevel(const EqualizerSections& sections, double frequency, double fs) noexcept
{
    return Decibels::fromGain(std::abs(designEqualizer(sections, fs).response(Hertz(frequency), fs))).value;
}

/// The frequency axis of the bilinear transform, squared: tan^2(pi f / fs). Levels are rational in it.
[[nodiscard]] inline double warpedSquare(double frequency, double fs) noexcept
{
    const double tangent = std::tan(std::numbers::pi * frequency / fs);
    return tangent * tangent;
}

/// Derivatives of one section's level, one value per point.
struct SectionSlopes
{
    std::span<double> frequency; ///< dB per unit of ln(frequency)
    std::span<double> gain;      ///< dB per dB
    std::span<double> q;         ///< dB per unit of ln(q)
};

/// The squared magnitude of a peak or shelf (see Biquad.h) as a function of t = tan^2(pi f / fs) / tan^2(pi f0 / fs),
/// so that neither the points nor the sections need trigonometry or complex numbers. With A = 10^(gain / 40) and
/// k = 1/q, from the cookbook's prototypes at s = j sqrt(t):
///   peak       ((1 - t)^2 + A^2 k^2 t) / ((1 - t)^2 + k^2 t / A^2)
///   low shelf  A^2 S, high shelf A^2 / S, S = ((A - t)^2 + A k^2 t) / ((1 - A t)^2 + A k^2 t)
/// A high shelf of -G dB is a low shelf of G dB, lowered by G dB.
class SectionCurve
{
public:
    SectionCurve(const EqualizerSection& section, double fs) noexcept
        : type(section.type),
          scale(1.0 / warpedSquare(section.frequency, fs)),
          a(std::pow(10.0, section.gain / 40.0)),
          kSquared(1.0 / (section.q * section.q))
    {
        const double w = 2.0 * std::numbers::pi * section.frequency / fs;
        warp = w / std::sin(w); // d ln(tan(w / 2)) / d ln(f0)
    }

    /// Multiplies `power` by the squared magnitude at each of `points`, tan^2(pi f / fs).
    void multiply(std::span<const double> points, std::span<double> power) const noexcept
    {
        forEach(points, [&](std::size_t i, const Terms& x) { power[i] *= factor * (x.above / x.below); });
    }

    /// The derivatives of the level in dB.
    void differentiate(std::span<const double> points, const SectionSlopes& slopes) const noexcept
    {
        constexpr double decibels = 10.0 / std::numbers::ln10;
        const double byFrequency = -2.0 * warp * decibels;
        forEach(points,
                [&](std::size_t i, const Terms& x)
                {
                    const double both = 1.0 / (x.above * x.below); // one division, the slowest operation here
                    const double overAbove = both * x.below;
                    const double overBelow = both * x.above;
                    slopes.frequency[i] = byFrequency * (x.aboveByT * overAbove - x.belowByT * overBelow);
                    slopes.gain[i] = gainOffset + 0.25 * (x.aboveByA * overAbove - x.belowByA * overBelow);
                    slopes.q[i] = -2.0 * decibels * (x.aboveByK * overAbove - x.belowByK * overBelow);
                });
    }

private:
    /// Numerator and denominator, and their derivatives by ln t, ln A and half of those by ln k.
    struct Terms
    {
        double above, below;
        double aboveByT, belowByT;
        double aboveByA, belowByA;
        double aboveByK, belowByK;
    };

    template <typename Use>
    void forEach(std::span<const double> points, const Use& use) const noexcept
    {
        const std::size_t n = points.size();
        if (type == EqualizerType::peak)
        {
            const double widthAbove = kSquared * a * a;
            const double widthBelow = kSquared / (a * a);
            for (std::size_t i = 0; i < n; ++i)
            {
                const double t = points[i] * scale;
                const double rest = 1.0 - t;
                const double square = rest * rest;
                const double slope = -2.0 * t * rest;
                const double above = widthAbove * t;
                const double below = widthBelow * t;
                use(i, Terms{square + above, square + below, slope + above, slope + below, 2.0 * above, -2.0 * below,
                             above, below});
            }
            return;
        }
        const auto shelf = [&](auto isLow)
        {
            const double width = kSquared * a;
            for (std::size_t i = 0; i < n; ++i)
            {
                const double t = points[i] * scale;
                const double middle = width * t;
                const double rest1 = a - t;
                const double rest2 = 1.0 - a * t;
                const double one = rest1 * rest1 + middle;
                const double oneByT = middle - 2.0 * t * rest1;
                const double oneByA = middle + 2.0 * a * rest1;
                const double two = rest2 * rest2 + middle;
                const double twoByTOrA = middle - 2.0 * a * t * rest2;
                if constexpr (isLow())
                    use(i, Terms{one, two, oneByT, twoByTOrA, oneByA, twoByTOrA, middle, middle});
                else
                    use(i, Terms{two, one, twoByTOrA, oneByT, twoByTOrA, oneByA, middle, middle});
            }
        };
        if (type == EqualizerType::lowShelf)
            shelf(std::true_type{});
        else
            shelf(std::false_type{});
    }

    EqualizerType type;
    double scale;
    double a;
    double kSquared;
    double warp = 1.0;
    double factor = type == EqualizerType::peak ? 1.0 : a * a;
    double gainOffset = type == EqualizerType::peak ? 0.0 : 0.5;
};

} // namespace pacini
