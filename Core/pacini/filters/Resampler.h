#pragma once

// Offline sample-rate conversion by a rational factor.

#include <pacini/foundation/DotProduct.h>
#include <pacini/foundation/DotProducts.h>
#include <pacini/foundation/Result.h>
#include <pacini/foundation/SizeInMemory.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

/// The rates that resample() and everything built on it accepts.
inline constexpr int lowestResamplerRate = 2000;    ///< Hz
inline constexpr int highestResamplerRate = 768000; ///< Hz

namespace detail
{
/// Linear-phase low-pass of 20 max(up, down) + 1 taps at up times the input rate: a sinc that is cut off at the lower
/// Nyquist frequency, a Kaiser window of shape 5, gain `up` at 0 Hz.
[[nodiscard]] inline std::vector<double> resamplingFilter(std::int64_t up, std::int64_t down)
{
    const auto rate = static_cast<std::size_t>(std::max(up, down));
    const std::size_t half = 10 * rate;
    // The window is I0(beta sqrt(w)), w = 1 - u^2: as a power series it is a polynomial in w, whose terms are taken for
    // all taps at once. 20 terms leave 1e-20. (besselI0() would find its terms anew for each of up to 15 million
    // taps.)
    constexpr double beta = 5.0;
    constexpr std::size_t terms = 20;
    std::array<double, terms> series{1.0};
    for (std::size_t k = 1; k < terms; ++k)
        series[k] = series[k - 1] * (beta * beta / 4.0) / static_cast<double>(k * k);
    std::vector<double> w(half + 1); // by distance from the centre
    for (std::size_t i = 0; i <= half; ++i)
    {
        const double u = static_cast<double>(i) / static_cast<double>(half);
        w[i] = 1.0 - u * u;
    }
    std::vector<double> side(half + 1, series.back());
    for (std::size_t k = terms - 1; k-- > 0;)
        for (std::size_t i = 0; i <= half; ++i)
            side[i] = side[i] * w[i] + series[k];

    std::vector<double> sine(rate); // of half a period; the following ones repeat it with changing sign
    for (std::size_t i = 0; i < rate; ++i)
        sine[i] = std::sin(std::numbers::pi * static_cast<double>(i) / static_cast<double>(rate));
    double sum = side[0];
    for (std::size_t begin = 0; begin < half; begin += rate)
    {
        const double sign = begin / rate % 2 == 0 ? 1.0 : -1.0;
        for (std::size_t i = begin == 0 ? 1 : 0; i < rate; ++i)
        {
            const double angle = std::numbers::pi * static_cast<double>(begin + i) / static_cast<double>(rate);
            side[begin + i] *= sign * sine[i] / angle;
            sum += 2.0 * side[begin + i];
        }
    }
    side[half] = 0.0; // sin(10 pi)

    std::vector<double> taps(2 * half + 1);
    const double gain = static_cast<double>(up) / sum;
    for (std::size_t i = 0; i <= half; ++i)
        taps[half - i] = taps[half + i] = gain * side[i];
    return taps;
}
} // namespace detail

/// Samples that a signal of `inputs` samples has at another rate: inputs * outputRate / inputRate, rounded up. Rates
/// above 0 in any unit.
[[nodiscard]] inline std::size_t resampledFrames(std::size_t inputs, std::int64_t inputRate,
                                                 std::int64_t outputRate) noexcept
{
    return sizeInMemory((static_cast<std::int64_t>(inputs) * outputRate + inputRate - 1) / inputRate);
}

/// Converts between two integer rates by a polyphase FIR filter. It is the filter that
/// scipy.signal.resample_poly(x, up, down) uses by default, so that figures made with SciPy can be compared: windowed
/// sinc, half length 10 max(up, down), cut off (-6 dB) at the lower of both Nyquist frequencies, Kaiser window of shape
/// 5 (stop band about -54 dB); zeros before and after the signal; output 0 lies at input 0. Polyphase form: R.
/// Crochiere and L. Rabiner, "Multirate Digital Signal Processing", 1983, section 3.3; each output costs 20 max(1,
/// inputRate / outputRate) multiplications whatever the common multiple of the rates is. `Sample` is float or double;
/// the filter runs in that precision.
template <typename Sample>
class Resampler
{
public:
    /// Both rates are in Hz, above 0 (resample() checks the documented range). Stores about 20 max(rates) / gcd(rates)
    /// taps.
    Resampler(int inputRate, int outputRate)
        : up(outputRate / std::gcd(inputRate, outputRate)), down(inputRate / std::gcd(inputRate, outputRate))
    {
        if (up == down)
            return;
        const auto filter = detail::resamplingFilter(up, down);
        const std::int64_t half = 10 * std::max(up, down);
        const std::int64_t padding = down - half % down; // so that the filter's centre falls on an output
        const auto padded = static_cast<std::int64_t>(filter.size()) + padding;
        tapsPerPhase = (padded + up - 1) / up;
        skippedOutputs = (half + padding) / down;

        // Rows of reversed taps in the order in which consecutive outputs need them.
        taps.resize(static_cast<std::size_t>(up * tapsPerPhase));
        auto* tap = taps.data();
        for (std::int64_t row = 0; row < up; ++row)
        {
            std::int64_t i = (skippedOutputs + row) * down % up + up * (tapsPerPhase - 1) - padding;
            for (std::int64_t k = 0; k < tapsPerPhase; ++k, ++tap, i -= up)
                if (i >= 0 && i < static_cast<std::int64_t>(filter.size()))
                    *tap = static_cast<Sample>(filter[static_cast<std::size_t>(i)]);
        }
    }

    /// Output samples for `inputs` input samples: inputs * up / down, rounded up.
    [[nodiscard]] std::size_t outputFrames(std::size_t inputs) const noexcept
    {
        return resampledFrames(inputs, down, up);
    }

    /// The first input sample that output `output` depends on (may be negative).
    [[nodiscard]] std::int64_t firstInput(std::size_t output) const noexcept
    {
        return up == down ? static_cast<std::int64_t>(output) : lastInput(output) - tapsPerPhase + 1;
    }

    /// The last input sample that output `output` depends on.
    [[nodiscard]] std::int64_t lastInput(std::size_t output) const noexcept
    {
        return (static_cast<std::int64_t>(output) + skippedOutputs) * down / up;
    }

    /// Writes the outputs firstOutput .. firstOutput + out.size() - 1. `window` holds the input from its sample
    /// `windowBegin` on; what lies outside the window counts as zero, so a caller who streams passes at least the
    /// inputs firstInput() .. lastInput() that exist.
    void process(std::span<const Sample> window, std::int64_t windowBegin, std::size_t firstOutput,
                 std::span<Sample> out) const noexcept
    {
        const auto size = static_cast<std::int64_t>(window.size());
        const auto position = (static_cast<std::int64_t>(firstOutput) + skippedOutputs) * down;
        std::int64_t row = static_cast<std::int64_t>(firstOutput) % up;
        std::int64_t phase = position % up;
        std::int64_t last = position / up - windowBegin;
        const auto advance = [&]
        {
            last += down / up;
            phase += down % up;
            if (phase >= up)
            {
                phase -= up;
                ++last;
            }
            if (++row == up)
                row = 0;
        };
        // Outputs that are `up` apart have the same taps, and their inputs are `down` apart.
        constexpr std::size_t together = 4;
        const auto turn = static_cast<std::size_t>(up);
        const auto reach = static_cast<std::int64_t>(together) * down;
        for (std::size_t done = 0; done < out.size();)
        {
            const std::int64_t first = last - tapsPerPhase + 1;
            if (up != down && first >= 0 && last + reach < size && out.size() - done >= together * turn)
            {
                for (std::size_t i = 0; i < turn; ++i, advance())
                {
                    const auto values = dotProducts<together>(
                        taps.data() + row * tapsPerPhase, window.data() + (last - tapsPerPhase + 1),
                        static_cast<std::size_t>(down), static_cast<std::size_t>(tapsPerPhase));
                    for (std::size_t k = 0; k < together; ++k)
                        out[done + i + k * turn] = values[k];
                }
                last += reach - down; // of which it has come `down`
                done += together * turn;
                continue;
            }
            Sample& y = out[done++];
            if (up == down)
                y = last >= 0 && last < size ? window[static_cast<std::size_t>(last)] : Sample(0);
            else
            {
                const std::int64_t begin = std::max<std::int64_t>(first, 0);
                const std::int64_t end = std::min(last + 1, size);
                y = begin < end ? dotProduct(taps.data() + row * tapsPerPhase + (begin - first), window.data() + begin,
                                             static_cast<std::size_t>(end - begin))
                                : Sample(0);
            }
            advance();
        }
    }

private:
    std::int64_t up;
    std::int64_t down;
    std::int64_t tapsPerPhase = 1;
    std::int64_t skippedOutputs = 0; // of the causal filter, until its centre has come in
    std::vector<Sample> taps;
};

/// Success, or ErrorCode::invalidArgument when `rate` (Hz) is outside 2000 to 768000.
[[nodiscard]] inline Result<void> checkResamplerRate(int rate)
{
    if (rate < lowestResamplerRate || rate > highestResamplerRate)
        return Error{ErrorCode::invalidArgument, "sampleRate",
                     "is " + std::to_string(rate) + " Hz, outside " + std::to_string(lowestResamplerRate) + " to " +
                         std::to_string(highestResamplerRate) + " Hz"};
    return {};
}

/// The whole signal `x` at another rate: see Resampler. The same rate gives a copy, an empty signal an empty one.
/// ErrorCode::invalidArgument for rates outside 2000 to 768000 Hz.
template <typename Sample>
[[nodiscard]] Result<std::vector<Sample>> resample(std::span<const Sample> x, int inputRate, int outputRate)
{
    for (const int rate : {inputRate, outputRate})
        if (auto valid = checkResamplerRate(rate); !valid)
            return valid.error();
    const Resampler<Sample> resampler(inputRate, outputRate);
    std::vector<Sample> y(resampler.outputFrames(x.size()));
    resampler.process(x, 0, 0, y);
    return y;
}

} // namespace pacini
