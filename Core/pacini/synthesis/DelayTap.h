#pragma once

// Fractional delay line with moving delays of one signal.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Fractional delay line. Remembers a signal and reads it back with delays that may change from sample to sample:
/// between samples by the cubic through four of them (Lagrange), flat within 0.1 dB up to an eighth of the rate. Haptic
/// signals end far below.
class DelayTap
{
public:
    DelayTap() = default;

    /// For delays up to `longest` frames and blocks up to `block` frames. Allocates.
    DelayTap(double longest, std::size_t block)
        : history(static_cast<std::size_t>(std::ceil(longest)) + 4), buffer(history + block, 0.0f)
    {
    }

    void reset() noexcept { std::fill(buffer.begin(), buffer.end(), 0.0f); }

    /// The next samples of the signal. [audio]
    void write(std::span<const float> samples) noexcept
    {
        const std::size_t n = samples.size();
        if (last > 0)
            std::copy(buffer.begin() + static_cast<std::ptrdiff_t>(last),
                      buffer.begin() + static_cast<std::ptrdiff_t>(last + history), buffer.begin());
        std::copy(samples.begin(), samples.end(), buffer.begin() + static_cast<std::ptrdiff_t>(history));
        last = n;
    }

    /// Sample `n` of the last block, `delay` frames late, 1 frame at least for the cubic: it adds 1 to every delay.
    [[nodiscard]] float read(std::size_t n, double delay) const noexcept
    {
        const double whole = std::floor(delay);
        const double u = delay - whole; // towards the older sample
        const std::size_t at = history + n - 1 - static_cast<std::size_t>(whole);
        const double newer = static_cast<double>(buffer[at + 1]), a = static_cast<double>(buffer[at]),
                     b = static_cast<double>(buffer[at - 1]), older = static_cast<double>(buffer[at - 2]);
        const double value = -u * (u - 1.0) * (u - 2.0) / 6.0 * newer + (u + 1.0) * (u - 1.0) * (u - 2.0) / 2.0 * a -
                             (u + 1.0) * u * (u - 2.0) / 2.0 * b + (u + 1.0) * u * (u - 1.0) / 6.0 * older;
        return static_cast<float>(value);
    }

private:
    std::size_t history = 4;
    std::vector<float> buffer;
    std::size_t last = 0;
};

} // namespace pacini
