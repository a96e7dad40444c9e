#pragma once

// Low-latency decimator by a whole factor, which does not wait for whole groups of frames.

#include <pacini/foundation/DotProduct.h>
#include <pacini/foundation/Windows.h>

#include <algorithm>
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
/// further delay. On demand it also samples what the filter removes, anew for every second frame: enough for its
/// power. Those samples lie on all phases of the frames in turn, so that tones at multiples of the inner rate have
/// theirs too.
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
        kept = coefficients.size() - 1 + ratio - 1;
        phaseStep = stepThrough(ratio);
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
        phase = 0;
        high = 0.0f;
        fresh = true;
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
                highs[k] = nextHigh(to + until);
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

    /// Samples the part that the filter removes, at one of the newest `ratio` inputs before `until`.
    float nextHigh(const float* until) noexcept
    {
        if (std::exchange(fresh, !fresh))
        {
            const std::size_t taps = coefficients.size();
            const float* last = until - phase;
            phase = (phase + phaseStep) % ratio;
            high = quiet > kept ? 0.0f
                                : *(last - 1 - latencyFrames()) - dotProduct(last - taps, coefficients.data(), taps);
        }
        return high;
    }

    /// A step that comes through all of `count` phases, far from one to the next.
    [[nodiscard]] static std::size_t stepThrough(std::size_t count)
    {
        std::size_t step = std::max<std::size_t>(1, (3 * count + 4) / 8);
        while (std::gcd(step, count) > 1)
            ++step;
        return step % count;
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

    std::size_t ratio;
    std::vector<float> coefficients; // symmetric
    std::size_t kept = 0;            // inputs that are still needed
    std::vector<float> line;         // those and room
    std::size_t end = 0;             // of the inputs in the line
    std::size_t untilFrame = 0;      // inputs before the one that completes a frame
    std::size_t phase = 0;           // of the next sample of what the filter removes
    std::size_t phaseStep = 1;
    float high = 0.0f;
    bool fresh = true; // the next frame gets another
    float peak = 0.0f;
    std::size_t quiet = 0; // newest inputs that are 0, as far as they matter
};

} // namespace pacini
