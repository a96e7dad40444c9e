#pragma once

// Frame means of smooth curves by quadrature, from few samples.

#include <pacini/foundation/DotProduct.h>

#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// The mean over `spacing * intervals` neighbouring fine samples, from a curve of which only every `spacing`-th is
/// known. Trapezoidal rule with two end corrections by central differences (the Gauss-Gregory formula; F. Hildebrand,
/// "Introduction to Numerical Analysis", 1956, section 5.8): the rule alone would be 9 % wrong for a component of six
/// samples per period, this is 0.4 %. It reads two samples beyond each end of the frame.
class FrameMean
{
public:
    static constexpr std::size_t reachFrames = 2;

    FrameMean(std::size_t intervals, std::size_t spacing)
    {
        std::vector<double> weights(intervals + 1 + 2 * reachFrames);
        for (std::size_t i = 0; i <= intervals; ++i)
            weights[reachFrames + i] = i == 0 || i == intervals ? 0.5 : 1.0;
        // -1/12 of the first and 11/720 of the third central difference, at the end minus at the start.
        const double difference[] = {-11.0 / 1440.0, 22.0 / 1440.0 + 1.0 / 24.0, 0.0, -22.0 / 1440.0 - 1.0 / 24.0,
                                     11.0 / 1440.0};
        for (std::size_t i = 0; i < 5; ++i)
        {
            weights[intervals + i] += difference[i];
            weights[i] -= difference[i];
        }
        // The fine samples 0 .. n - 1 cover -0.5 to n - 0.5, half a sample earlier than the coarse intervals.
        const double early = 0.5 / static_cast<double>(spacing);
        weights[reachFrames] += early;
        weights[reachFrames + intervals] -= early;
        for (const double weight : weights)
            taps.push_back(static_cast<float>(weight / static_cast<double>(intervals)));
    }

    /// The mean of the frame that starts at x[first]; reads x[first - 2] to x[first + intervals + 2].
    [[nodiscard]] float of(std::span<const float> x, std::size_t first) const noexcept
    {
        return dotProduct(taps.data(), x.data() + first - reachFrames, taps.size());
    }

private:
    std::vector<float> taps;
};

} // namespace pacini
