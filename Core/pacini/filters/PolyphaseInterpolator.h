#pragma once

// Polyphase interpolator: raises the rate of a band-limited signal by a whole factor.

#include <pacini/foundation/Windows.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// The rows of a polyphase filter: for each of some numbers its weights in the output frames of all phases. What is
/// computed at once are neighbouring frames, not neighbouring products: no sum has to be taken apart.
class PolyphaseRows
{
public:
    PolyphaseRows() = default;
    PolyphaseRows(std::size_t phases, std::size_t rows)
        : ratio(phases), stride((phases + width - 1) / width * width), weights(rows * stride, 0.0f)
    {
    }

    [[nodiscard]] float& at(std::size_t row, std::size_t phase) noexcept { return weights[row * stride + phase]; }
    [[nodiscard]] float at(std::size_t row, std::size_t phase) const noexcept { return weights[row * stride + phase]; }

    /// Returns one output frame for each phase: the first rows applied to `first`, the rows after them to `second`.
    void process(std::span<const float> first, std::span<const float> second, float* target) const noexcept
    {
        for (std::size_t p = 0; p < ratio;)
            p += outputs(first, second, p, target + p);
    }

private:
    static constexpr std::size_t width = 4; ///< outputs in one vector register

    /// Computes the outputs from phase `p` on, as many as there are registers for, and returns their number. A sum
    /// waits for its last addition at every row: several registers side by side wait at the same time.
    std::size_t outputs(std::span<const float> first, std::span<const float> second, std::size_t p,
                        float* target) const noexcept
    {
        const std::size_t left = ratio - p;
        if (left > 3 * width)
            return outputs<4>(first, second, p, target);
        if (left > 2 * width)
            return outputs<3>(first, second, p, target);
        return left > width ? outputs<2>(first, second, p, target) : outputs<1>(first, second, p, target);
    }

    template <std::size_t registers>
    std::size_t outputs(std::span<const float> first, std::span<const float> second, std::size_t p,
                        float* target) const noexcept
    {
        float sums[registers * width] = {};
        const float* row = weights.data() + p;
        for (std::size_t i = 0; i < first.size(); ++i, row += stride)
            for (std::size_t k = 0; k < registers * width; ++k)
                sums[k] += first[i] * row[k];
        for (std::size_t i = 0; i < second.size(); ++i, row += stride)
            for (std::size_t k = 0; k < registers * width; ++k)
                sums[k] += second[i] * row[k];
        const std::size_t count = std::min(registers * width, ratio - p);
        std::copy_n(sums, count, target);
        return count;
    }

    std::size_t ratio = 1;
    std::size_t stride = width; // ratio rounded up to whole vector registers
    std::vector<float> weights; // [row][stride]
};

/// The newest numbers of a signal, newest first and always in one piece.
class NewestFirst
{
public:
    explicit NewestFirst(std::size_t count = 1) : length(count), kept(2 * count, 0.0f) {}

    void reset() noexcept { std::fill(kept.begin(), kept.end(), 0.0f); } // then it does not matter where the newest is

    /// Takes the next number and returns the newest ones.
    std::span<const float> push(float x) noexcept
    {
        // Each is kept twice.
        newest = newest == 0 ? length - 1 : newest - 1;
        kept[newest] = x;
        kept[newest + length] = x;
        return std::span(kept).subspan(newest, length);
    }

    [[nodiscard]] bool silent() const noexcept
    {
        return std::all_of(kept.begin(), kept.end(), [](float x) { return x == 0.0f; });
    }

private:
    std::size_t length;
    std::vector<float> kept;
    std::size_t newest = 0;
};

/// Windowed-sinc filter in polyphase form that raises the rate by a whole factor (Crochiere and Rabiner, "Multirate
/// Digital Signal Processing", 1983, ch. 2). Frequencies up to `pass` (cycles per input frame) keep their level within
/// 0.01 dB, images are 70 dB down or more, 79 dB for `pass` of 0.3 and above, where the filters are long. Immutable:
/// interpolators can share it.
class InterpolatorDesign
{
public:
    /// `passes` in (0, 0.45). Allocates.
    InterpolatorDesign(std::size_t factor, double passes) : ratio(factor), pass(passes)
    {
        assert(factor >= 1 && pass > 0.0 && pass < 0.45);
        if (ratio > 1)
        {
            design();
            return;
        }
        coefficients = PolyphaseRows(1, 1);
        coefficients.at(0, 0) = 1.0f;
    }

    [[nodiscard]] std::size_t factor() const noexcept { return ratio; }

    /// A row for each input frame that an output frame depends on, the newest first.
    [[nodiscard]] const PolyphaseRows& rows() const noexcept { return coefficients; }
    [[nodiscard]] std::size_t taps() const noexcept { return tapsPerPhase; }

    /// Whether it is that of these arguments.
    [[nodiscard]] bool isOf(std::size_t factor, double passes) const noexcept
    {
        return ratio == factor && (pass == passes || factor == 1);
    }

private:
    void design()
    {
        constexpr double attenuation = 80.0;
        const double transition =
            1.0 - 2.0 * pass; // from the pass band's end to the first image, cycles per input frame
        tapsPerPhase = kaiserTaps(attenuation, transition);
        tapsPerPhase += tapsPerPhase % 2;
        const KaiserWindow window(kaiserBeta(attenuation));
        const double half = 0.5 * static_cast<double>(tapsPerPhase);
        coefficients = PolyphaseRows(ratio, tapsPerPhase);
        for (std::size_t p = 0; p < ratio; ++p)
        {
            // Input i steps back from the newest, seen from an output p / factor steps after the middle one.
            const auto row = windowedSinc(tapsPerPhase, 0.5, static_cast<double>(p) / static_cast<double>(ratio), half,
                                          window, half);
            for (std::size_t i = 0; i < tapsPerPhase; ++i)
                coefficients.at(i, p) = static_cast<float>(row[i]);
        }
    }

    std::size_t ratio;
    double pass;
    std::size_t tapsPerPhase = 1;
    PolyphaseRows coefficients;
};

/// Cache of the last requested designs, for many interpolators of one design: a design costs more than all the rest of
/// a decoder. [worker], from one thread at a time; the designs may be used and freed anywhere.
class InterpolatorDesigns
{
public:
    /// The same as a new InterpolatorDesign. Allocates.
    [[nodiscard]] std::shared_ptr<const InterpolatorDesign> get(std::size_t factor, double pass)
    {
        const auto found =
            std::find_if(kept.begin(), kept.end(), [&](const auto& design) { return design->isOf(factor, pass); });
        if (found == kept.end())
        {
            if (kept.size() == most)
                kept.pop_back();
            kept.insert(kept.begin(), std::make_shared<const InterpolatorDesign>(factor, pass));
        }
        else
            std::rotate(kept.begin(), found, found + 1); // used last
        return kept.front();
    }

private:
    static constexpr std::size_t most = 64; // of about 2 kB

    std::vector<std::shared_ptr<const InterpolatorDesign>> kept; // used last first
};

/// Interpolation by a whole factor with an InterpolatorDesign: every output frame costs `taps` products. Linear phase;
/// the delay is latencyFrames() output frames. Not a DspBlock: it has more output than input.
class PolyphaseInterpolator
{
public:
    /// `pass` in (0, 0.45).
    PolyphaseInterpolator(std::size_t factor, double pass)
        : PolyphaseInterpolator(std::make_shared<const InterpolatorDesign>(factor, pass))
    {
    }

    /// Uses a design, not null, that others may use at the same time.
    explicit PolyphaseInterpolator(std::shared_ptr<const InterpolatorDesign> shared)
        : design(std::move(shared)), history(design->taps())
    {
    }

    [[nodiscard]] std::size_t factor() const noexcept { return design->factor(); }
    [[nodiscard]] std::size_t latencyFrames() const noexcept { return (design->taps() / 2) * design->factor(); }

    /// A row for each input frame that an output frame depends on, the newest first.
    [[nodiscard]] const PolyphaseRows& rows() const noexcept { return design->rows(); }
    [[nodiscard]] std::size_t taps() const noexcept { return design->taps(); }

    void reset() noexcept { history.reset(); }

    /// `out` has factor() times as many frames as `in`.
    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        const std::size_t ratio = design->factor();
        assert(out.size() == in.size() * ratio);
        float* target = out.data();
        for (const float x : in)
        {
            design->rows().process(history.push(x), {}, target);
            target += ratio;
        }
    }

private:
    std::shared_ptr<const InterpolatorDesign> design;
    NewestFirst history;
};

} // namespace pacini
