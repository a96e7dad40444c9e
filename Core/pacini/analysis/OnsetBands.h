#pragma once

// Band powers for onset detection: one channel -> the powers of OnsetFrames.

#include <pacini/analysis/OnsetDecimator.h>
#include <pacini/analysis/OnsetFrame.h>
#include <pacini/analysis/OnsetOctaves.h>
#include <pacini/analysis/OnsetSums.h>
#include <pacini/analysis/SlidingBuffer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace pacini
{

/// The analysis of one channel. Zero phase: frame k describes the time from k/900 to (k+1)/900 s.
class OnsetBands
{
public:
    /// `sampleRate` from 2 kHz to 768 kHz.
    explicit OnsetBands(double sampleRate)
        : mirrorLength(static_cast<std::ptrdiff_t>(0.06 * sampleRate)),
          decimator(sampleRate, mirrorLength),
          inputSamples(sampleRate),
          stageSamples(decimator.stageRate())
    {
        // The second difference rises by 12 dB per octave; it is scaled to pass 6-7 kHz unchanged at every rate.
        const double relative = decimator.stageRate() / 22050.0;
        bendScale = static_cast<float>(std::max(relative * relative * relative * relative / 4.0, 1.0 / 16.0));
        dcCoefficient = 1.0 - std::exp(-2.0 * std::numbers::pi * 6.0 / OnsetFrame::rate);
    }

    /// Adds the samples first[0], first[stride], ... first[(count - 1) stride] less `offset`, the DC of the sound.
    void push(const float* first, std::ptrdiff_t stride, std::ptrdiff_t count, float offset)
    {
        decimator.push(first, stride, count, offset);
        octaves.extend(decimator.base());
    }

    /// Lets the sound run backwards from its end for 60 ms, so that the frames up to the end can be completed without
    /// the end itself looking like an event.
    void mirrorEnd()
    {
        const std::int64_t end = decimator.input().end();
        std::vector<float> mirrored(static_cast<std::size_t>(mirrorLength));
        for (std::ptrdiff_t i = 0; i < std::min<std::int64_t>(mirrorLength, end); ++i)
            mirrored[static_cast<std::size_t>(i)] = *decimator.input().at(end - 1 - i);
        push(mirrored.data(), 1, mirrorLength, 0.0f);
    }

    /// Adds `weight` times the powers of the frames that are complete, at most `limit` frames in all, to `frames`,
    /// whose element 0 is frame `first`; grows `frames` as needed. Returns the index after the last frame.
    std::int64_t emit(std::vector<OnsetFrame>& frames, std::int64_t first, std::int64_t limit, float weight)
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
        decimator.forget(inputSamples.begin, stageSamples.begin, octaves.forget(next));
        return next;
    }

private:
    static constexpr std::ptrdiff_t pitchFrames = 16; ///< half width of the window that measures the lowest pitch

    /// The samples of the coming frame in a signal of some rate: those at times in [k/900, (k+1)/900).
    struct Samples
    {
        double perFrame = 0.0;
        std::int64_t begin = 0;
        std::int64_t end = 0;

        explicit Samples(double rate) : perFrame(rate / OnsetFrame::rate), end(start(1)) {}

        [[nodiscard]] std::int64_t start(std::int64_t frame) const noexcept
        {
            const double position = static_cast<double>(frame) * perFrame;
            const auto whole = static_cast<std::int64_t>(position);
            return whole + (static_cast<double>(whole) < position ? 1 : 0); // the ceiling, without a library call
        }

        void advanceTo(std::int64_t frame) noexcept
        {
            begin = end;
            end = start(frame + 1);
        }

        [[nodiscard]] std::ptrdiff_t count() const noexcept { return static_cast<std::ptrdiff_t>(end - begin); }
    };

    [[nodiscard]] bool complete(std::int64_t frame) const noexcept
    {
        return frame + pitchFrames + 2 <= octaves.lowest().end() && inputSamples.end <= decimator.input().end() &&
               stageSamples.end + 1 <= decimator.stage().end();
    }

    static float square(float v) noexcept { return v * v; }
    static float slope(const float* x) noexcept { return 0.5f * (x[1] - x[-1]); }

    void add(OnsetFrame& frame, float weight)
    {
        const std::int64_t k = next;
        const double mean = static_cast<double>(detail::sumOfEight(decimator.base().at(8 * k))) / 8.0;
        dc += dcCoefficient * (mean - dc);
        const float squares = detail::sumOfSquares(decimator.input().at(inputSamples.begin), inputSamples.count());
        const double power =
            static_cast<double>(squares) / static_cast<double>(inputSamples.count()) - dc * (2.0 * mean - dc);

        std::array<float, OnsetFrame::bandCount> band{};
        const std::ptrdiff_t stageCount = stageSamples.count();
        band[6] = bendScale * detail::sumOfSquaredBends(decimator.stage().at(stageSamples.begin), stageCount) /
                  static_cast<float>(stageCount);
        band[5] = detail::sumOfSquares(octaves.high(0).at(8 * k), 8) / 8.0f;
        band[4] = detail::sumOfSquares(octaves.high(1).at(8 * k), 8) / 8.0f;
        band[3] = detail::sumOfSquares(octaves.high(2).at(4 * k), 4) / 4.0f;

        // Below 450 Hz a frame is shorter than a half wave. The energy of an oscillation, x^2 + (x'/omega)^2, stays
        // steady through its phases; an octave is narrow enough to take one omega (where sin(omega) = 0.9) for all of
        // it.
        constexpr float octaveScale = 1.0f / (0.9f * 0.9f);
        const float* h3 = octaves.high(3).at(2 * k);
        const float* h4 = octaves.high(4).at(k);
        band[2] = 0.25f * (square(h3[0]) + square(h3[1]) + octaveScale * (square(slope(h3)) + square(slope(h3 + 1))));
        band[1] = 0.5f * (square(h4[0]) + octaveScale * square(slope(h4)));

        // The lowest band is too wide for one omega: it is measured as <x'^2>/<x^2> around the frame.
        const float* x = octaves.lowest().at(k);
        band[0] = 0.5f * (square(*x) + static_cast<float>(squaredPeriod(k)) * square(slope(x)));

        const float* low = octaves.low().at(8 * k);
        std::array<float, 8> lowHalf;
        std::transform(low, low + 8, lowHalf.begin(),
                       [offset = static_cast<float>(dc)](float v) { return v - offset; });

        frame.power += weight * static_cast<float>(std::max(0.0, power));
        frame.lowPower += weight * detail::sumOfSquares(lowHalf.data(), 8) / 8.0f;
        for (std::size_t b = 0; b < band.size(); ++b)
        {
            frame.bands[b] += weight * band[b];
            frame.bands[OnsetFrame::bandCount] += weight * band[b];
        }
    }

    /// <x^2>/<x'^2> of the lowest band over 33 frames around frame k.
    double squaredPeriod(std::int64_t k)
    {
        for (; measured < k + pitchFrames + 1; ++measured)
        {
            const auto slot = static_cast<std::size_t>(measured % std::ssize(pitchSquares));
            const float* x = octaves.lowest().at(measured);
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

    std::ptrdiff_t mirrorLength; ///< samples
    OnsetDecimator decimator;
    OnsetOctaves octaves;
    Samples inputSamples;
    Samples stageSamples;
    float bendScale = 1.0f;

    std::int64_t next = 0; ///< the frame to come
    double dcCoefficient = 0.0;
    double dc = 0.0; ///< of the full band, slowly following
    std::int64_t measured = 0;
    std::array<std::array<double, 2>, 2 * pitchFrames + 1> pitchSquares{};
    std::array<double, 2> pitchSums{};
};

} // namespace pacini
