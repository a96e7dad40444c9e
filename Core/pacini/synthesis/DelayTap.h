#pragma once

// Fractional delay line.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>

namespace pacini
{

/// Fractional delay line. Remembers a signal and reads it back with delays that may change from sample to sample:
/// between samples by the cubic through four of them (Lagrange), flat within 0.1 dB up to an eighth of the rate. Haptic
/// signals end far below. Within the newest frame the cubic leans on older samples, so that whole delays, 0 among
/// them, are exact.
class DelayTap
{
public:
    /// For delays up to `longest` frames and blocks up to `block` frames. Allocates, and fills nothing: a play that
    /// starts has a line of its own, long enough for delays that it may never be given.
    DelayTap(double longest, std::size_t block)
        : frames(std::bit_ceil(static_cast<std::size_t>(std::ceil(longest)) + 3 + block)), ring(new float[frames])
    {
    }

    void reset() noexcept { before = last = 0; }

    /// The next samples of the signal. [audio]
    void write(std::span<const float> samples) noexcept
    {
        begun = (begun + last) & (frames - 1);
        before = std::min(before + last, frames);
        last = samples.size();
        const std::size_t first = std::min(last, frames - begun);
        std::copy_n(samples.begin(), first, ring.get() + begun);
        std::copy_n(samples.begin() + static_cast<std::ptrdiff_t>(first), last - first, ring.get());
    }

    /// Sample `n` of the last block, `delay` frames late. [audio]
    [[nodiscard]] float read(std::size_t n, double delay) const noexcept
    {
        const double newest = std::max(std::floor(delay) - 1.0, 0.0);        // of the four samples
        const double u = delay - newest;                                     // from it towards the oldest, 0 to 3
        const std::size_t at = begun + n - static_cast<std::size_t>(newest); // may wrap, as the ring does
        const auto written = static_cast<std::ptrdiff_t>(before + n) - static_cast<std::ptrdiff_t>(newest);
        const auto older = [&](std::size_t by) // silence, before the first sample
        {
            return static_cast<std::ptrdiff_t>(by) > written ? 0.0
                                                             : static_cast<double>(ring[(at - by) & (frames - 1)]);
        };
        const double a = older(0), b = older(1), c = older(2), d = older(3);
        const double value = -(u - 1.0) * (u - 2.0) * (u - 3.0) / 6.0 * a + u * (u - 2.0) * (u - 3.0) / 2.0 * b -
                             u * (u - 1.0) * (u - 3.0) / 2.0 * c + u * (u - 1.0) * (u - 2.0) / 6.0 * d;
        return static_cast<float>(value);
    }

private:
    std::size_t frames;            // of the ring, a power of two
    std::unique_ptr<float[]> ring; // NOLINT(modernize-avoid-c-arrays): a vector would be filled
    std::size_t begun = 0;         // where the last block begins
    std::size_t last = 0;          // its frames
    std::size_t before = 0;        // written before it since the start, at most `frames`
};

} // namespace pacini
