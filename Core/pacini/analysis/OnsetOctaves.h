#pragma once

// Octave filter bank for onset detection: splits the low part of one channel.

#include <pacini/analysis/OnsetFrame.h>
#include <pacini/analysis/SlidingBuffer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace pacini
{

/// Divides a signal of 7200 Hz at 1800, 900, 450, 225 and 112 Hz by short symmetric filters, at falling rates and zero
/// phase: each step leaves the upper part of what remains in high(0), high(1) ... and halves the rest again.
class OnsetOctaves
{
public:
    static constexpr std::size_t splits = 5;

    /// Samples of high(i), and of the rest low(i), per OnsetFrame.
    static constexpr std::array<std::ptrdiff_t, splits> samplesPerFrame{8, 8, 4, 2, 1};

    /// Processes new samples of the base signal. The signal begins with 8 or more zeros before index 0.
    void extend(const SlidingBuffer<float>& base)
    {
        split(base, 1, lows[0], highs[0]);
        split(lows[0], 2, lows[1], highs[1]);
        for (std::size_t i = 0; i < halves.size(); ++i)
        {
            decimate(lows[i + 1], halves[i]);
            split(halves[i], 2, lows[i + 2], highs[i + 2]);
        }
        removeDrift();
    }

    /// The upper part of split i: 1800-3600, 900-1800, 450-900, 225-450, 112-225 Hz.
    [[nodiscard]] const SlidingBuffer<float>& high(std::size_t i) const noexcept { return highs[i]; }

    /// All below 1800 Hz, 8 samples per frame.
    [[nodiscard]] const SlidingBuffer<float>& low() const noexcept { return lows[0]; }

    /// 6-112 Hz, one sample per frame.
    [[nodiscard]] const SlidingBuffer<float>& lowest() const noexcept { return rest; }

    /// Declares that nothing before frame `next`, and 4 samples before it in any signal, will be read again. Returns
    /// the index before which the base signal is not needed.
    std::int64_t forget(std::int64_t next)
    {
        // Each signal keeps what the next one and the coming frame read.
        const std::int64_t baseBefore = std::min(lows[0].end() - 4, 8 * next);
        lows[0].forget(std::min(lows[1].end() - 8, 8 * next));
        for (std::size_t i = 0; i < halves.size(); ++i)
        {
            lows[i + 1].forget(2 * halves[i].end() - 2);
            halves[i].forget(lows[i + 2].end() - 8);
        }
        lows.back().forget(rest.end());
        rest.forget(next - 4);
        for (std::size_t i = 0; i < splits; ++i)
            highs[i].forget(samplesPerFrame[i] * next - 4);
        return baseBefore;
    }

private:
    static constexpr std::ptrdiff_t history = 32; ///< zeros before the start that filters can see
    using Signal = SlidingBuffer<float>;

    /// Halves a band: low + high = x. Maximally flat half-band low-pass of 7 taps, (-1 0 9 16 9 0 -1)/32, and its
    /// complement; with `step` 2 the edge is at an eighth of the rate instead of a quarter.
    static void split(const Signal& from, std::ptrdiff_t step, Signal& lowTo, Signal& highTo)
    {
        const std::int64_t begin = lowTo.end();
        const std::ptrdiff_t count = lowTo.missingTo(from.end() - 3 * step);
        if (count == 0)
            return;
        const float* x = from.at(begin);
        const float* l1 = x - step;
        const float* r1 = x + step;
        const float* l3 = x - 3 * step;
        const float* r3 = x + 3 * step;
        float* low = lowTo.extend(count);
        float* high = highTo.extend(count);
        for (std::ptrdiff_t i = 0; i < count; ++i)
        {
            const float even = 0.5f * x[i];
            const float odd = (9.0f / 32.0f) * (l1[i] + r1[i]) - (1.0f / 32.0f) * (l3[i] + r3[i]);
            low[i] = even + odd;
            high[i] = even - odd;
        }
    }

    static void decimate(const Signal& from, Signal& to)
    {
        const std::int64_t begin = to.end();
        const std::ptrdiff_t count = to.missingTo((from.end() + 1) / 2);
        if (count == 0)
            return;
        float* y = to.extend(count);
        const float* x = from.at(2 * begin);
        for (std::ptrdiff_t i = 0; i < count; ++i)
            y[i] = x[2 * i];
    }

    /// The lowest band without DC: a one-pole high-pass at 6 Hz.
    void removeDrift()
    {
        const std::int64_t begin = rest.end();
        const std::ptrdiff_t count = rest.missingTo(lows.back().end());
        if (count == 0)
            return;
        float* y = rest.extend(count);
        const float* x = lows.back().at(begin);
        for (std::ptrdiff_t i = 0; i < count; ++i)
        {
            drift += driftCoefficient * (static_cast<double>(x[i]) - drift);
            y[i] = x[i] - static_cast<float>(drift);
        }
    }

    std::array<Signal, splits> lows{Signal(history), Signal(history), Signal(history), Signal(history),
                                    Signal(history)};
    std::array<Signal, splits> highs = lows;
    std::array<Signal, 3> halves{Signal(history), Signal(history), Signal(history)}; ///< at 3600, 1800, 900 Hz
    Signal rest{history};
    double driftCoefficient = 1.0 - std::exp(-2.0 * std::numbers::pi * 6.0 / OnsetFrame::rate);
    double drift = 0.0;
};

} // namespace pacini
