#pragma once

// Splits one channel into the band powers of OnsetFrame, by short symmetric FIR filters at falling sample rates.

#include <pacini/analysis/OnsetFrame.h>
#include <pacini/analysis/SlidingBuffer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

namespace detail
{
// Sums run in four fixed lanes: compilers turn them into vector code without changing the order of additions.
using Lanes = std::array<float, 4>;

inline float total(const Lanes& v) noexcept
{
    return (v[0] + v[2]) + (v[1] + v[3]);
}

/// Sum of x[i]^2, i = 0..count-1.
inline float sumOfSquares(const float* x, std::ptrdiff_t count) noexcept
{
    Lanes sum{};
    std::ptrdiff_t i = 0;
    for (; i + 4 <= count; i += 4)
        for (std::size_t l = 0; l < 4; ++l)
            sum[l] += x[i + std::ptrdiff_t(l)] * x[i + std::ptrdiff_t(l)];
    float rest = 0.0f;
    for (; i < count; ++i)
        rest += x[i] * x[i];
    return total(sum) + rest;
}

/// x[0] + ... + x[7].
inline float sum8(const float* x) noexcept
{
    Lanes sum{};
    for (std::size_t l = 0; l < 4; ++l)
        sum[l] = x[l] + x[l + 4];
    return total(sum);
}

/// Sum of (x[i-1] - 2 x[i] + x[i+1])^2, i = 0..count-1.
inline float sumOfSquaredBends(const float* x, std::ptrdiff_t count) noexcept
{
    Lanes sum{};
    std::ptrdiff_t i = 0;
    for (; i + 4 <= count; i += 4)
        for (std::size_t l = 0; l < 4; ++l)
        {
            const float* p = x + i + std::ptrdiff_t(l);
            const float bend = (p[1] - p[0]) - (p[0] - p[-1]);
            sum[l] += bend * bend;
        }
    float rest = 0.0f;
    for (; i < count; ++i)
    {
        const float bend = (x[i + 1] - x[i]) - (x[i] - x[i - 1]);
        rest += bend * bend;
    }
    return total(sum) + rest;
}

/// Sum of a[i] b[i]; `count` is a multiple of 4.
inline float dot(const float* a, const float* b, std::ptrdiff_t count) noexcept
{
    Lanes sum{};
    for (std::ptrdiff_t i = 0; i < count; i += 4)
        for (std::size_t l = 0; l < 4; ++l)
            sum[l] += a[i + std::ptrdiff_t(l)] * b[i + std::ptrdiff_t(l)];
    return total(sum);
}

/// Halves a band: low + high = x. Maximally flat half-band low-pass of 7 taps, (-1 0 9 16 9 0 -1)/32, and its
/// complement; with `step` 2 the edge is at an eighth of the rate instead of a quarter.
inline void splitBand(const float* x, std::ptrdiff_t step, std::ptrdiff_t count, float* low, float* high) noexcept
{
    const float* l1 = x - step;
    const float* r1 = x + step;
    const float* l3 = x - 3 * step;
    const float* r3 = x + 3 * step;
    for (std::ptrdiff_t i = 0; i < count; ++i)
    {
        const float even = 0.5f * x[i];
        const float odd = (9.0f / 32.0f) * (l1[i] + r1[i]) - (1.0f / 32.0f) * (l3[i] + r3[i]);
        low[i] = even + odd;
        high[i] = even - odd;
    }
}
} // namespace detail

/// The analysis of one channel. Zero phase: frame k describes the time from k/900 to (k+1)/900 s.
class OnsetBands
{
public:
    /// `sampleRate` from 2 kHz to 768 kHz.
    explicit OnsetBands(double sampleRate)
        : stageRate(sampleRate / std::exp2(stageCount(sampleRate))),
          inputSamples(sampleRate),
          stageSamples(stageRate),
          mirrorLength(static_cast<std::ptrdiff_t>(0.06 * sampleRate)),
          input(history),
          stages(static_cast<std::size_t>(stageCount(sampleRate)), SlidingBuffer<float>(history))
    {
        designResampler();
        // The second difference rises by 12 dB per octave; it is scaled to pass 6-7 kHz unchanged at every rate.
        const double relative = stageRate / 22050.0;
        bendScale = static_cast<float>(std::max(relative * relative * relative * relative / 4.0, 1.0 / 16.0));
        dcCoefficient = 1.0 - std::exp(-2.0 * std::numbers::pi * 6.0 / OnsetFrame::rate);
    }

    /// Adds the samples first[0], first[stride], ... first[(count - 1) stride] less `offset`, the DC of the sound.
    void push(const float* first, std::ptrdiff_t stride, std::ptrdiff_t count, float offset)
    {
        float* x = input.extend(count);
        if (stride == 1) // this case becomes vector code
            for (std::ptrdiff_t i = 0; i < count; ++i)
                x[i] = first[i] - offset;
        else
            for (std::ptrdiff_t i = 0; i < count; ++i)
                x[i] = first[i * stride] - offset;
        halve();
        resample();
        split(base, 1, low[0], high[0]);
        split(low[0], 2, low[1], high[1]);
        decimate(low[1], octave[0]);
        split(octave[0], 2, low[2], high[2]);
        decimate(low[2], octave[1]);
        split(octave[1], 2, low[3], high[3]);
        decimate(low[3], octave[2]);
        split(octave[2], 2, low[4], high[4]);
        removeDrift();
    }

    /// Lets the sound run backwards from its end for 60 ms, so that the frames up to the end can be completed without
    /// the end itself looking like an event.
    void mirrorEnd()
    {
        const std::ptrdiff_t end = input.end();
        std::vector<float> mirrored(static_cast<std::size_t>(mirrorLength));
        for (std::ptrdiff_t i = 0; i < std::min(mirrorLength, end); ++i)
            mirrored[static_cast<std::size_t>(i)] = *input.at(end - 1 - i);
        push(mirrored.data(), 1, mirrorLength, 0.0f);
    }

    /// Adds `weight` times the powers of the frames that are complete, at most `limit` frames in all, to `frames`,
    /// whose element 0 is frame `first`; grows `frames` as needed. Returns the index after the last frame.
    std::ptrdiff_t emit(std::vector<OnsetFrame>& frames, std::ptrdiff_t first, std::ptrdiff_t limit, float weight)
    {
        for (; next < limit && complete(next); ++next)
        {
            const auto slot = static_cast<std::size_t>(next - first);
            if (slot == frames.size())
                frames.emplace_back();
            add(frames[slot], weight);
            inputSamples.advanceTo(next + 1);
            stageSamples.advanceTo(next + 1);
        }
        forget();
        return next;
    }

private:
    static constexpr double baseRate = 8.0 * OnsetFrame::rate;
    static constexpr std::ptrdiff_t history = 32; ///< silence before the start that the longest filter can see
    static constexpr std::ptrdiff_t phases = 64;
    static constexpr std::ptrdiff_t pitchFrames =
        16; ///< half width of the window that measures the lowest band's pitch

    /// The samples of the coming frame in a signal of some rate: those at times in [k/900, (k+1)/900).
    struct Samples
    {
        double perFrame = 0.0;
        std::ptrdiff_t begin = 0;
        std::ptrdiff_t end = 0;

        explicit Samples(double rate) : perFrame(rate / OnsetFrame::rate), end(start(1)) {}

        [[nodiscard]] std::ptrdiff_t start(std::ptrdiff_t frame) const noexcept
        {
            const double position = static_cast<double>(frame) * perFrame;
            const auto whole = static_cast<std::ptrdiff_t>(position);
            return whole + (static_cast<double>(whole) < position ? 1 : 0); // the ceiling, without a library call
        }

        void advanceTo(std::ptrdiff_t frame) noexcept
        {
            begin = end;
            end = start(frame + 1);
        }
    };

    void designResampler()
    {
        // Hann-windowed sinc, -6 dB at 2.7 kHz. Short: what folds back stays some 20 dB down, enough for powers.
        const double span = 16.0 * std::max(1.0, stageRate / 22050.0);
        taps = 8 * static_cast<std::ptrdiff_t>(std::ceil(span / 8.0));
        const double half = static_cast<double>(taps) / 2.0;
        const double cutoff = std::min(1.0, 2.0 * 2700.0 / stageRate);
        table.resize(static_cast<std::size_t>(phases * taps));
        for (std::ptrdiff_t p = 0; p < phases; ++p)
        {
            double sum = 0.0;
            std::vector<double> h(static_cast<std::size_t>(taps));
            for (std::size_t i = 0; i < h.size(); ++i)
            {
                const double t =
                    static_cast<double>(i) - half + 1.0 - static_cast<double>(p) / static_cast<double>(phases);
                const double window = std::abs(t) < half ? std::cos(std::numbers::pi * t / (2.0 * half)) : 0.0;
                const double x = std::numbers::pi * cutoff * t;
                h[i] = window * window * (t == 0.0 ? 1.0 : std::sin(x) / x);
                sum += h[i];
            }
            for (std::size_t i = 0; i < h.size(); ++i)
                table[static_cast<std::size_t>(p * taps) + i] = static_cast<float>(h[i] / sum);
        }
    }

    /// How often the rate is halved to come below 40 kHz.
    static int stageCount(double sampleRate) noexcept
    {
        int count = 0;
        for (; sampleRate >= 40000.0; sampleRate *= 0.5)
            ++count;
        return count;
    }

    [[nodiscard]] SlidingBuffer<float>& stage() noexcept { return stages.empty() ? input : stages.back(); }

    void halve()
    {
        const SlidingBuffer<float>* from = &input;
        for (SlidingBuffer<float>& to : stages)
        {
            const std::ptrdiff_t begin = to.end();
            const std::ptrdiff_t count = from->end() / 2 - begin; // the last needs its right neighbour
            if (count <= 0)
                return;
            float* y = to.extend(count);
            const float* x = from->at(2 * begin);
            for (std::ptrdiff_t i = 0; i < count; ++i)
                y[i] = 0.5f * x[2 * i] + 0.25f * (x[2 * i - 1] + x[2 * i + 1]);
            from = &to;
        }
    }

    void resample()
    {
        const SlidingBuffer<float>& from = stage();
        const std::ptrdiff_t begin = base.end();
        const double step = stageRate / baseRate;
        const auto ready = static_cast<double>(from.end() - taps / 2 - 2);
        const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(std::floor(ready / step)) - begin;
        if (count <= 0)
            return;
        float* y = base.extend(count);
        for (std::ptrdiff_t i = 0; i < count; ++i)
        {
            const double position = static_cast<double>(begin + i) * step * static_cast<double>(phases);
            const auto place = static_cast<std::ptrdiff_t>(position + 0.5);
            const std::ptrdiff_t whole = place / phases;
            const float* filter = table.data() + (place % phases) * taps;
            y[i] = detail::dot(from.at(whole - taps / 2 + 1), filter, taps);
        }
    }

    static void split(const SlidingBuffer<float>& from, std::ptrdiff_t step, SlidingBuffer<float>& lowTo,
                      SlidingBuffer<float>& highTo)
    {
        const std::ptrdiff_t begin = lowTo.end();
        const std::ptrdiff_t count = from.end() - 3 * step - begin;
        if (count > 0)
            detail::splitBand(from.at(begin), step, count, lowTo.extend(count), highTo.extend(count));
    }

    static void decimate(const SlidingBuffer<float>& from, SlidingBuffer<float>& to)
    {
        const std::ptrdiff_t begin = to.end();
        const std::ptrdiff_t count = (from.end() + 1) / 2 - begin;
        if (count <= 0)
            return;
        float* y = to.extend(count);
        const float* x = from.at(2 * begin);
        for (std::ptrdiff_t i = 0; i < count; ++i)
            y[i] = x[2 * i];
    }

    /// The lowest band without DC: a one-pole high-pass at 6 Hz.
    void removeDrift()
    {
        const std::ptrdiff_t begin = lowest.end();
        const std::ptrdiff_t count = low[4].end() - begin;
        if (count <= 0)
            return;
        float* y = lowest.extend(count);
        const float* x = low[4].at(begin);
        for (std::ptrdiff_t i = 0; i < count; ++i)
        {
            drift += dcCoefficient * (static_cast<double>(x[i]) - drift);
            y[i] = x[i] - static_cast<float>(drift);
        }
    }

    [[nodiscard]] bool complete(std::ptrdiff_t frame) noexcept
    {
        return frame + pitchFrames + 2 <= lowest.end() && inputSamples.end <= input.end() &&
               stageSamples.end + 1 <= stage().end();
    }

    static float square(float v) noexcept { return v * v; }
    static float slope(const float* x) noexcept { return 0.5f * (x[1] - x[-1]); }

    void add(OnsetFrame& frame, float weight)
    {
        const std::ptrdiff_t k = next;
        const std::ptrdiff_t length = inputSamples.end - inputSamples.begin;
        const double mean = static_cast<double>(detail::sum8(base.at(8 * k))) / 8.0;
        dc += dcCoefficient * (mean - dc);
        const double square0 = static_cast<double>(detail::sumOfSquares(input.at(inputSamples.begin), length));
        const double power = square0 / static_cast<double>(length) - dc * (2.0 * mean - dc);
        const auto offset = static_cast<float>(dc);

        std::array<float, OnsetFrame::bandCount> band{};
        const std::ptrdiff_t stageLength = stageSamples.end - stageSamples.begin;
        band[6] = bendScale * detail::sumOfSquaredBends(stage().at(stageSamples.begin), stageLength) /
                  static_cast<float>(stageLength);
        band[5] = detail::sumOfSquares(high[0].at(8 * k), 8) / 8.0f;
        band[4] = detail::sumOfSquares(high[1].at(8 * k), 8) / 8.0f;
        band[3] = detail::sumOfSquares(high[2].at(4 * k), 4) / 4.0f;

        // Below 450 Hz a frame is shorter than a half wave. The energy of an oscillation, x^2 + (x'/omega)^2, stays
        // steady through its phases; an octave is narrow enough to take one omega (where sin(omega) = 0.9) for all of
        // it.
        constexpr float octaveScale = 1.0f / (0.9f * 0.9f);
        const float* h3 = high[3].at(2 * k);
        const float* h4 = high[4].at(k);
        band[2] = 0.25f * (square(h3[0]) + square(h3[1]) + octaveScale * (square(slope(h3)) + square(slope(h3 + 1))));
        band[1] = 0.5f * (square(h4[0]) + octaveScale * square(slope(h4)));

        // The lowest band is too wide for one omega: it is measured as <x'^2>/<x^2> around the frame.
        const float* x = lowest.at(k);
        band[0] = 0.5f * (square(*x) + static_cast<float>(squaredPeriod(k)) * square(slope(x)));

        std::array<float, 8> lowHalf;
        std::transform(low[0].at(8 * k), low[0].at(8 * k) + 8, lowHalf.begin(),
                       [offset](float v) { return v - offset; });

        frame.power += weight * static_cast<float>(std::max(0.0, power));
        frame.lowPower += weight * detail::sumOfSquares(lowHalf.data(), 8) / 8.0f;
        for (std::size_t b = 0; b < band.size(); ++b)
        {
            frame.bands[b] += weight * band[b];
            frame.bands[OnsetFrame::bandCount] += weight * band[b];
        }
    }

    /// <x^2>/<x'^2> of the lowest band over 33 frames around frame k.
    double squaredPeriod(std::ptrdiff_t k)
    {
        for (; measured < k + pitchFrames + 1; ++measured)
        {
            const auto slot = static_cast<std::size_t>(measured % std::ssize(pitchSquares));
            const float* x = lowest.at(measured);
            const std::array<double, 2> now{static_cast<double>(square(*x)), static_cast<double>(square(slope(x)))};
            for (std::size_t i = 0; i < 2; ++i)
            {
                pitchSums[i] += now[i] - pitchSquares[slot][i];
                pitchSquares[slot][i] = now[i];
            }
        }
        // The band reaches from 6 to some 150 Hz; outside its limits the ratio is rounding noise.
        return std::clamp(pitchSums[0] / std::max(pitchSums[1], 1e-30), 1.0, 600.0);
    }

    void forget()
    {
        // Each signal keeps what the next one and the coming frame read.
        const auto resampled = static_cast<std::ptrdiff_t>(static_cast<double>(base.end()) * stageRate / baseRate);
        const std::ptrdiff_t staged = std::min(stageSamples.begin, resampled - taps / 2) - 4;
        const std::ptrdiff_t halved = stages.empty() ? staged : 2 * stages.front().end() - 4;
        input.forget(std::min({inputSamples.begin, halved, input.end() - mirrorLength}));
        for (std::size_t i = 0; i + 1 < stages.size(); ++i)
            stages[i].forget(2 * stages[i + 1].end() - 4);
        if (!stages.empty())
            stages.back().forget(staged);
        base.forget(std::min(low[0].end() - 4, 8 * next));
        low[0].forget(std::min(low[1].end() - 8, 8 * next));
        low[1].forget(2 * octave[0].end() - 2);
        octave[0].forget(low[2].end() - 8);
        low[2].forget(2 * octave[1].end() - 2);
        octave[1].forget(low[3].end() - 8);
        low[3].forget(2 * octave[2].end() - 2);
        octave[2].forget(low[4].end() - 8);
        low[4].forget(lowest.end());
        lowest.forget(next - 4);
        high[0].forget(8 * next);
        high[1].forget(8 * next);
        high[2].forget(4 * next);
        high[3].forget(2 * next - 4);
        high[4].forget(next - 4);
    }

    double stageRate;
    Samples inputSamples;
    Samples stageSamples;
    std::ptrdiff_t mirrorLength;
    std::ptrdiff_t taps = 0;
    std::vector<float> table; ///< phases x taps
    float bendScale = 1.0f;
    double dcCoefficient = 0.0;

    SlidingBuffer<float> input;               ///< at fs
    std::vector<SlidingBuffer<float>> stages; ///< fs/2, fs/4 ... down to 20-40 kHz
    SlidingBuffer<float> base{history};       ///< at 7200 Hz
    std::array<SlidingBuffer<float>, 5> low{SlidingBuffer<float>{history}, SlidingBuffer<float>{history},
                                            SlidingBuffer<float>{history}, SlidingBuffer<float>{history},
                                            SlidingBuffer<float>{history}};
    std::array<SlidingBuffer<float>, 5> high = low;
    std::array<SlidingBuffer<float>, 3> octave{SlidingBuffer<float>{history}, SlidingBuffer<float>{history},
                                               SlidingBuffer<float>{history}}; ///< 3600, 1800, 900 Hz

    SlidingBuffer<float> lowest{history}; ///< low[4] without DC

    std::ptrdiff_t next = 0; ///< the frame to come
    double dc = 0.0;         ///< of the full band, slowly following
    double drift = 0.0;      ///< of the lowest band
    std::ptrdiff_t measured = 0;
    std::array<std::array<double, 2>, 2 * pitchFrames + 1> pitchSquares{};
    std::array<double, 2> pitchSums{};
};

} // namespace pacini
