#pragma once

// Bands that add up to the signal itself, for changing their levels without bending it.

#include <pacini/filters/BandLayout.h>
#include <pacini/filters/DesignLimits.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/realtime/ControlHop.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace pacini
{

/// Constant-voltage crossovers of third order (R. H. Small, "Constant-voltage crossover network design", JAES 19
/// (1971)): with u = 1 / (s + 1) the low part is (1 + 3 s) u^3 = 3 u^2 - 2 u^3, the high part what is left. Neighbours
/// at equal gains leave no trace, neither in level nor in time, where the crossovers of FilterBank turn the phase and
/// delay 100 Hz by about 10 ms; the price is slopes of 12 dB per octave. Each edge is three one-poles by trapezoidal
/// integration (V. Zavalishin, "The Art of VA Filter Design", 2012), side by side for all edges. The range ends at the
/// outer edges of the layout with the same slopes.
class DirectBank
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

    /// out[n] = sum of gain times band; `gains` has one ramp for each band, read but not moved. Adds the power of
    /// every band to what takePowers() gives. At most one hop.
    void process(std::span<const double> in, std::span<const HopRamp> gains, std::span<double> out) noexcept
    {
        std::array<double, room> weights{}, moves{};
        for (std::size_t e = 0; e < edges; ++e)
        {
            // The sum of gain (low[k + 1] - low[k]) over the bands, ordered by edges.
            const bool below = e > 0, above = e + 1 < edges;
            weights[e] = (below ? gains[e - 1].value() : 0.0) - (above ? gains[e].value() : 0.0);
            moves[e] = (below ? gains[e - 1].perFrame() : 0.0) - (above ? gains[e].perFrame() : 0.0);
        }
        std::array<double, room + 1> low{};
        for (std::size_t n = 0; n < in.size(); ++n)
        {
            for (std::size_t e = 0; e < width; ++e)
            {
                const double v1 = (in[n] - first[e]) * steps[e];
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
            double sum[2] = {};
            for (std::size_t e = 0; e < width; e += 2)
                for (std::size_t i = 0; i < 2; ++i)
                {
                    weights[e + i] += moves[e + i];
                    sum[i] += weights[e + i] * low[e + i];
                    const double band = low[e + i + 1] - low[e + i];
                    powers[e + i] += band * band;
                }
            out[n] = sum[0] + sum[1];
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
