#pragma once

// Band level meter: levels of the bands of a sound, at low cost.

#include <pacini/filters/BandLayout.h>
#include <pacini/filters/DesignLimits.h>
#include <pacini/foundation/DspBlock.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace pacini
{

/// Band level meter. Powers of bands cut by constant-voltage crossovers of third order (R. H. Small, "Constant-voltage
/// crossover network design", JAES 19 (1971)): with u = 1 / (s + 1) the low part is (1 + 3 s) u^3 = 3 u^2 - 2 u^3. Each
/// edge is three one-poles by trapezoidal integration (V. Zavalishin, "The Art of VA Filter Design", 2012); all edges
/// stand side by side in vector registers, so that twelve bands cost less than one of FilterBank. Slopes of 12 dB per
/// octave are enough for the eye and for a motor, which has one strength only.
class BandMeter
{
public:
    /// Real-time safe; silence follows.
    void design(const BandLayout& layout, double fs) noexcept
    {
        edges = layout.bands() + 1;
        steps = {};
        for (std::size_t e = 0; e < edges; ++e)
        {
            const Hertz edge = e < layout.bands() ? layout.lowerEdge(e) : layout.upperEdge(e - 1);
            const double g = std::tan(std::numbers::pi * clampedFrequency(edge, fs) / fs);
            steps[e] = g / (1.0 + g);
        }
        width = (edges + 1) / 2 * 2;
        reset();
    }

    void reset() noexcept
    {
        first = second = third = {};
        powers = {};
    }

    void process(std::span<const double> in) noexcept
    {
        std::array<double, room + 1> low{};
        for (const double x : in)
        {
            for (std::size_t e = 0; e < width; ++e)
            {
                const double v1 = (x - first[e]) * steps[e];
                const double y1 = first[e] + v1;
                first[e] = y1 + v1;
                const double v2 = (y1 - second[e]) * steps[e];
                const double y2 = second[e] + v2;
                second[e] = y2 + v2;
                const double v3 = (y2 - third[e]) * steps[e];
                const double y3 = third[e] + v3;
                third[e] = y3 + v3;
                low[e] = 3.0 * y2 - 2.0 * y3;
            }
            for (std::size_t e = 0; e < width; ++e)
            {
                const double band = low[e + 1] - low[e];
                powers[e] += band * band;
            }
        }
    }

    /// The sum of the squares of band k since the last call.
    [[nodiscard]] double takePower(std::size_t k) noexcept
    {
        const double power = powers[k];
        powers[k] = 0.0;
        return power;
    }

    void flush() noexcept
    {
        for (std::size_t e = 0; e < edges; ++e)
        {
            flushTiny(first[e]);
            flushTiny(second[e]);
            flushTiny(third[e]);
        }
    }

private:
    static constexpr std::size_t room = maxBands + 2; // edges, rounded up to whole vector registers

    std::size_t edges = 0;
    std::size_t width = 0;
    std::array<double, room> steps{};
    std::array<double, room> first{}, second{}, third{};
    std::array<double, room> powers{};
};

} // namespace pacini
