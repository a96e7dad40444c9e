#pragma once

// Low-latency decimator by a whole factor, which does not wait for whole groups of frames.

#include <pacini/foundation/DotProduct.h>
#include <pacini/foundation/Lanes.h>
#include <pacini/foundation/Windows.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Decimation by a whole factor with a linear-phase windowed sinc (Kaiser 1974; Crochiere and Rabiner, "Multirate
/// Digital Signal Processing", 1983, ch. 2). What folds onto the range below `pass` is 56 dB down or more; between
/// `pass` and the inner Nyquist frequency it may fold, so that the filter can be short: its delay is latencyFrames()
/// input frames, 0.4 ms at 6 kHz. Beside it stands the peak of all input since the frame before, which also tells of
/// what the filter removes. Frame k is made when input k * factor arrives: an interpolator that starts there needs no
/// further delay. On demand it also measures the level of what the filter removes.
/// Not finite input counts as 0, input is limited to +-100.
class WholeDecimator
{
public:
    static constexpr float largestInput = 100.0f;

    WholeDecimator() : WholeDecimator(1, 48000.0, 1000.0) {}

    /// Decimates from `fs` Hz to fs / factor Hz. Allocates.
    WholeDecimator(std::size_t factor, double fs, double pass) : ratio(factor)
    {
        assert(factor >= 1);
        coefficients.assign(1, 1.0f);
        if (ratio > 1)
            design(fs, pass);
        kept = coefficients.size() - 1 + (ratio + sideBySide - 1) / sideBySide * sideBySide - 1;
        line.assign(kept + std::max<std::size_t>(4096, 8 * coefficients.size()), 0.0f);
        reset();
    }

    [[nodiscard]] std::size_t factor() const noexcept { return ratio; }
    [[nodiscard]] std::size_t latencyFrames() const noexcept { return coefficients.size() / 2; }

    void reset() noexcept
    {
        std::fill(line.begin(), line.end(), 0.0f);
        end = kept;
        untilFrame = 0;
        peak = 0.0f;
        quiet = kept + 1;
    }

    /// Returns the number of frames that the next `inputs` frames of input complete.
    [[nodiscard]] std::size_t framesFor(std::size_t inputs) const noexcept
    {
        return inputs > untilFrame ? (inputs - untilFrame - 1) / ratio + 1 : 0;
    }

    /// Takes all of `in`, at most 1024 frames; `frames`, `peaks` and, where wanted, `highs` have framesFor(in.size())
    /// elements.
    void process(std::span<const float> in, std::span<float> frames, std::span<float> peaks,
                 std::span<float> highs = {}) noexcept
    {
        const std::size_t taps = coefficients.size();
        if (end + in.size() > line.size())
        {
            std::copy(line.begin() + static_cast<std::ptrdiff_t>(end - kept),
                      line.begin() + static_cast<std::ptrdiff_t>(end), line.begin());
            end = kept;
        }
        float* to = line.data() + end;
        for (std::size_t i = 0; i < in.size(); ++i)
        {
            const float x = std::abs(in[i]) <= std::numeric_limits<float>::max() ? in[i] : 0.0f;
            to[i] = x > largestInput ? largestInput : (x < -largestInput ? -largestInput : x);
        }
        std::size_t done = 0;
        for (std::size_t k = 0; k < frames.size(); ++k)
        {
            const std::size_t until = done + untilFrame + 1;
            notePeak(to + done, until - done);
            // When the whole filter lies on zeros its output is one.
            frames[k] = quiet >= taps ? 0.0f : dotProduct(to + until - taps, coefficients.data(), taps);
            if (!highs.empty())
                highs[k] = removed(to + until);
            peaks[k] = peak;
            peak = 0.0f;
            done = until;
            untilFrame = ratio - 1;
        }
        notePeak(to + done, in.size() - done);
        untilFrame -= in.size() - done;
        end += in.size();
    }

private:
    void notePeak(const float* x, std::size_t count) noexcept
    {
        float largest = 0.0f;
        for (std::size_t i = 0; i < count; ++i)
            largest = std::abs(x[i]) > largest ? std::abs(x[i]) : largest;
        quiet = largest > 0.0f ? 0 : std::min(quiet + count, kept + 1);
        peak = std::max(peak, largest);
    }

    /// Returns the root mean square of what the filter removes from the newest `ratio` inputs before `until`. All
    /// of them count: a short noise has no more or less for where the frames lie.
    [[nodiscard]] float removed(const float* until) const noexcept
    {
        if (quiet > kept)
            return 0.0f;
        using Inputs = Lanes<float, 4>;
        const std::size_t middle = latencyFrames();
        float power = 0.0f;
        for (std::size_t at = 0; at < ratio; at += sideBySide)
        {
            const float* newest = until - at - sideBySide; // of the earliest output
            const float* oldest = newest - 2 * middle;
            const auto rest = Inputs::all(1.0f - coefficients[middle]);
            Inputs early = rest * Inputs::load(oldest + middle), late = rest * Inputs::load(oldest + middle + 4);
            for (std::size_t i = 0; i < middle; ++i)
            {
                const auto tap = Inputs::all(coefficients[i]);
                early = early - tap * (Inputs::load(oldest + i) + Inputs::load(newest - i));
                late = late - tap * (Inputs::load(oldest + i + 4) + Inputs::load(newest - i + 4));
            }
            std::array<float, sideBySide> high;
            early.store(high.data());
            late.store(high.data() + 4);
            for (std::size_t k = at + sideBySide > ratio ? at + sideBySide - ratio : 0; k < sideBySide; ++k)
                power += high[k] * high[k];
        }
        return std::sqrt(power / static_cast<float>(ratio));
    }

    void design(double fs, double pass)
    {
        constexpr double attenuation = 60.0;
        const double inner = fs / static_cast<double>(ratio);
        const double width = (inner - 2.0 * pass) / fs; // from the pass band's end to what folds onto it
        std::size_t taps = kaiserTaps(attenuation, width);
        taps += 1 - taps % 2; // odd: a whole delay
        const double cutoff = 0.5 * inner / fs;
        const double middle = 0.5 * static_cast<double>(taps - 1);
        coefficients.clear();
        for (const double tap :
             windowedSinc(taps, cutoff, 0.0, middle, KaiserWindow(kaiserBeta(attenuation)), middle + 1.0))
            coefficients.push_back(static_cast<float>(tap));
    }

    static constexpr std::size_t sideBySide = 8; // outputs that are computed together

    std::size_t ratio;
    std::vector<float> coefficients; // symmetric
    std::size_t kept = 0;            // inputs that are still needed
    std::vector<float> line;         // those and room
    std::size_t end = 0;             // of the inputs in the line
    std::size_t untilFrame = 0;      // inputs before the one that completes a frame
    float peak = 0.0f;
    std::size_t quiet = 0; // newest inputs that are 0, as far as they matter
};

} // namespace pacini
