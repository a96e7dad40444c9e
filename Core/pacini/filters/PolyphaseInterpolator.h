#pragma once

// Polyphase interpolator: raises the rate of a band-limited signal by a whole factor.

#include <pacini/foundation/Windows.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Interpolation by a whole factor with a windowed-sinc filter in polyphase form (Crochiere and Rabiner, "Multirate
/// Digital Signal Processing", 1983, ch. 2): every output frame costs `taps` products. Linear phase; the delay is
/// latencyFrames() output frames. Frequencies up to `pass` (cycles per input frame) keep their level within 0.01 dB,
/// images are 70 dB down or more, 79 dB for `pass` of 0.3 and above, where the filters are long. Not a DspBlock: it has
/// more output than input.
class PolyphaseInterpolator
{
public:
    /// `pass` in (0, 0.45).
    PolyphaseInterpolator(std::size_t factor, double pass) : ratio(factor), stride((factor + width - 1) / width * width)
    {
        assert(factor >= 1 && pass > 0.0 && pass < 0.45);
        if (ratio == 1)
        {
            tapsPerPhase = 1;
            coefficients.assign(width, 1.0f);
        }
        else
            design(pass);
        history.assign(2 * tapsPerPhase, 0.0f);
    }

    [[nodiscard]] std::size_t factor() const noexcept { return ratio; }
    [[nodiscard]] std::size_t latencyFrames() const noexcept { return (tapsPerPhase / 2) * ratio; }

    void reset() noexcept
    {
        for (float& v : history) // of zeros it does not matter where the newest one is
            v = 0.0f;
    }

    /// `out` has factor() times as many frames as `in`.
    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        assert(out.size() == in.size() * ratio);
        float* target = out.data();
        for (const float x : in)
        {
            // Each sample is kept twice, so that the newest `taps` always lie in one piece.
            write = write == 0 ? tapsPerPhase - 1 : write - 1;
            history[write] = x;
            history[write + tapsPerPhase] = x;
            const float* newest = history.data() + write;
            for (std::size_t p = 0; p < ratio;)
                p += outputs(newest, p, target + p);
            target += ratio;
        }
    }

private:
    static constexpr std::size_t width = 4; ///< outputs in one vector register

    /// Computes the outputs from phase `p` on, as many as there are registers for, and returns their number. A sum
    /// waits for its last addition at every tap: several registers side by side wait at the same time.
    std::size_t outputs(const float* newest, std::size_t p, float* target) const noexcept
    {
        const std::size_t left = ratio - p;
        if (left > 3 * width)
            return outputs<4>(newest, p, target);
        if (left > 2 * width)
            return outputs<3>(newest, p, target);
        return left > width ? outputs<2>(newest, p, target) : outputs<1>(newest, p, target);
    }

    template <std::size_t registers>
    std::size_t outputs(const float* newest, std::size_t p, float* target) const noexcept
    {
        float sums[registers * width] = {};
        const float* row = coefficients.data() + p;
        for (std::size_t i = 0; i < tapsPerPhase; ++i, row += stride)
            for (std::size_t k = 0; k < registers * width; ++k)
                sums[k] += newest[i] * row[k];
        const std::size_t count = std::min(registers * width, ratio - p);
        std::copy_n(sums, count, target);
        return count;
    }

    void design(double pass)
    {
        constexpr double attenuation = 80.0;
        const double transition =
            1.0 - 2.0 * pass; // from the pass band's end to the first image, cycles per input frame
        tapsPerPhase = kaiserTaps(attenuation, transition);
        tapsPerPhase += tapsPerPhase % 2;
        const KaiserWindow window(kaiserBeta(attenuation));
        const double half = 0.5 * static_cast<double>(tapsPerPhase);
        coefficients.assign(tapsPerPhase * stride, 0.0f);
        for (std::size_t p = 0; p < ratio; ++p)
        {
            // Input i steps back from the newest, seen from an output p / factor steps after the middle one.
            const auto row = windowedSinc(tapsPerPhase, 0.5, static_cast<double>(p) / static_cast<double>(ratio), half,
                                          window, half);
            for (std::size_t i = 0; i < tapsPerPhase; ++i)
                coefficients[i * stride + p] = static_cast<float>(row[i]);
        }
    }

    std::size_t ratio;
    std::size_t stride; // ratio rounded up to whole vector registers
    std::size_t tapsPerPhase = 1;
    std::vector<float> coefficients; // [tap][stride]
    std::vector<float> history;
    std::size_t write = 0;
};

} // namespace pacini
