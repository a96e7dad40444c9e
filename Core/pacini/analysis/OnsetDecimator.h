#pragma once

// Decimation for onset detection: reduces one channel of any sample rate to the rates at which OnsetBands measures.

#include <pacini/analysis/OnsetFrame.h>
#include <pacini/analysis/OnsetSums.h>
#include <pacini/analysis/SlidingBuffer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace pacini
{

/// Three signals of the same sound, zero phase: sample i of a signal at rate r is at time i / r.
/// - input: at the sample rate;
/// - stage: halved until the rate is below 40 kHz, for the highest band;
/// - base: at 8 samples per OnsetFrame, for all other bands.
class OnsetDecimator
{
public:
    /// Samples of silence before the start of every signal; the longest filter reads no further.
    static constexpr std::ptrdiff_t history = 32;

    static constexpr double baseRate = 8.0 * OnsetFrame::rate; ///< Hz

    /// `sampleRate` from 2 kHz to 768 kHz. The last `kept` samples of the input are never forgotten.
    OnsetDecimator(double sampleRate, std::ptrdiff_t kept)
        : keptInput(kept),
          stageFs(sampleRate / std::exp2(stageCount(sampleRate))),
          inputSamples(history),
          stages(static_cast<std::size_t>(stageCount(sampleRate)), SlidingBuffer<float>(history))
    {
        designFilters();
    }

    /// Adds the samples first[0], first[stride], ... first[(count - 1) stride] less `offset`, the DC of the sound.
    void push(const float* first, std::ptrdiff_t stride, std::ptrdiff_t count, float offset)
    {
        float* x = inputSamples.extend(count);
        if (stride == 1) // this case becomes vector code
            for (std::ptrdiff_t i = 0; i < count; ++i)
                x[i] = first[i] - offset;
        else
            for (std::ptrdiff_t i = 0; i < count; ++i)
                x[i] = first[i * stride] - offset;
        halve();
        resample();
    }

    [[nodiscard]] const SlidingBuffer<float>& input() const noexcept { return inputSamples; }
    [[nodiscard]] const SlidingBuffer<float>& stage() const noexcept
    {
        return stages.empty() ? inputSamples : stages.back();
    }
    [[nodiscard]] const SlidingBuffer<float>& base() const noexcept { return baseSamples; }

    /// Hz, 20 to 40 kHz unless the input's rate is lower.
    [[nodiscard]] double stageRate() const noexcept { return stageFs; }

    /// Declares that nothing before these indices will be read again.
    void forget(std::int64_t inputBefore, std::int64_t stageBefore, std::int64_t baseBefore)
    {
        // Each signal also keeps what the next one still reads.
        const auto resampled = static_cast<std::int64_t>(static_cast<double>(baseSamples.end()) * stageFs / baseRate);
        const std::int64_t staged = std::min(stageBefore, resampled - taps / 2) - 4;
        const std::int64_t halved = stages.empty() ? staged : 2 * stages.front().end() - 4;
        inputSamples.forget(std::min({inputBefore, halved, inputSamples.end() - keptInput}));
        for (std::size_t i = 0; i + 1 < stages.size(); ++i)
            stages[i].forget(2 * stages[i + 1].end() - 4);
        if (!stages.empty())
            stages.back().forget(staged);
        baseSamples.forget(baseBefore);
    }

private:
    static constexpr std::ptrdiff_t phases = 64;

    /// Returns the number of halvings that bring the rate below 40 kHz.
    static int stageCount(double sampleRate) noexcept
    {
        int count = 0;
        for (; sampleRate >= 40000.0; sampleRate *= 0.5)
            ++count;
        return count;
    }

    void designFilters()
    {
        // Hann-windowed sinc, -6 dB at 2.7 kHz. Short: what folds back stays some 20 dB down, enough for powers.
        const double span = 16.0 * std::max(1.0, stageFs / 22050.0);
        taps = 8 * static_cast<std::ptrdiff_t>(std::ceil(span / 8.0));
        const double half = static_cast<double>(taps) / 2.0;
        const double cutoff = std::min(1.0, 2.0 * 2700.0 / stageFs);
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

    void halve()
    {
        const SlidingBuffer<float>* from = &inputSamples;
        for (SlidingBuffer<float>& to : stages)
        {
            const std::int64_t begin = to.end();
            const std::ptrdiff_t count = to.missingTo(from->end() / 2); // the last needs its right neighbour
            if (count == 0)
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
        const std::int64_t begin = baseSamples.end();
        const double step = stageFs / baseRate;
        const auto ready = static_cast<double>(from.end() - taps / 2 - 2);
        const std::ptrdiff_t count = baseSamples.missingTo(static_cast<std::int64_t>(std::floor(ready / step)));
        if (count == 0)
            return;
        float* y = baseSamples.extend(count);
        for (std::ptrdiff_t i = 0; i < count; ++i)
        {
            const double position = static_cast<double>(begin + i) * step * static_cast<double>(phases);
            const auto place = static_cast<std::int64_t>(position + 0.5);
            const std::int64_t whole = place / phases;
            const float* filter = table.data() + (place % phases) * taps;
            y[i] = detail::dotOfFours(from.at(whole - taps / 2 + 1), filter, taps);
        }
    }

    std::ptrdiff_t keptInput;
    double stageFs;
    std::ptrdiff_t taps = 0;
    std::vector<float> table; ///< phases x taps

    SlidingBuffer<float> inputSamples;
    std::vector<SlidingBuffer<float>> stages; ///< fs/2, fs/4 ... down to 20-40 kHz
    SlidingBuffer<float> baseSamples{history};
};

} // namespace pacini
