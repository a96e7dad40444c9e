#pragma once

// Envelope correction: makes a sum of sinusoids follow the envelope that it should have.

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// A moving average, worked on in hops of one fixed length: the sum is formed anew for each hop, so that rounding
/// cannot build up however long it runs.
class MovingAverage
{
public:
    MovingAverage(std::size_t window, std::size_t hopFrames) : length(window), buffer(window - 1 + hopFrames, 0.0) {}

    void reset() noexcept { std::fill(buffer.begin(), buffer.end(), 0.0); }

    /// values[n] becomes the mean of the `window` newest values up to n. `values` has the length of a hop.
    void process(std::span<double> values) noexcept
    {
        const std::size_t kept = length - 1;
        assert(kept + values.size() == buffer.size());
        std::copy(values.begin(), values.end(), buffer.begin() + static_cast<std::ptrdiff_t>(kept));
        const double scale = 1.0 / static_cast<double>(length);
        double sum = 0.0;
        for (std::size_t i = 0; i < kept; ++i)
            sum += buffer[i];
        for (std::size_t n = 0; n < values.size(); ++n)
        {
            sum += buffer[n + kept];
            values[n] = std::max(sum, 0.0) * scale;
            sum -= buffer[n];
        }
        std::copy(buffer.end() - static_cast<std::ptrdiff_t>(kept), buffer.end(), buffer.begin());
    }

private:
    std::size_t length;
    std::vector<double> buffer;
};

/// Envelope correction. Sinusoids that stand for bands beat against each other, which the source did not. The leveller
/// measures the magnitude of their analytic sum over a 10 ms window (a triangle, two moving averages) and scales it to
/// the wanted envelope, twice, since the first gain moves the magnitude within the window too. Beats slower than about
/// 50 Hz vanish; faster ones, which carry roughness, stay. Works in hops of a fixed length; output is delayed by
/// latencyFrames().
class EnvelopeLeveller
{
public:
    static constexpr double window = 0.010;    ///< s, whole length of the triangle
    static constexpr double largestGain = 8.0; ///< beats are not filled deeper than 18 dB

    /// Frames are those of the decoder's inner rate `fs`; hops have `hopFrames` frames.
    EnvelopeLeveller(double fs, std::size_t hopFrames) : box(boxFrames(fs)), hop(hopFrames), magnitude(hopFrames)
    {
        for (auto& pass : passes)
            pass = Pass(box, hop);
    }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return passes.size() * (box - 1); }

    void reset() noexcept
    {
        for (auto& pass : passes)
            pass.reset();
    }

    /// Levels one hop in place. `target(k)` is the wanted envelope of pass k for this hop, taken at the time that the
    /// pass puts out: (k + 1) * (window frames - 1) / 2 before its input.
    template <typename Target>
    void process(std::span<double> re, std::span<double> im, Target&& target) noexcept
    {
        for (std::size_t k = 0; k < passes.size(); ++k)
        {
            Pass& pass = passes[k];
            for (std::size_t n = 0; n < hop; ++n)
                magnitude[n] = std::sqrt(re[n] * re[n] + im[n] * im[n]);
            pass.first.process(magnitude);
            pass.second.process(magnitude);
            pass.delay(re, pass.re);
            pass.delay(im, pass.im);
            const std::span<const double> wanted = target(k);
            for (std::size_t n = 0; n < hop; ++n)
            {
                const double gain = std::min((wanted[n] + tiny) / (magnitude[n] + tiny), largestGain);
                re[n] *= gain;
                im[n] *= gain;
            }
        }
    }

    /// Frames by which pass k delays.
    [[nodiscard]] std::size_t delayOfPass(std::size_t k) const noexcept { return (k + 1) * (box - 1); }

    static constexpr std::size_t passCount = 2;

private:
    static constexpr double tiny = 1e-5; // -100 dB: silence stays silence

    static std::size_t boxFrames(double fs) { return static_cast<std::size_t>(std::lround(0.5 * window * fs)) | 1u; }

    struct Pass
    {
        Pass() : first(1, 1), second(1, 1) {}
        Pass(std::size_t box, std::size_t hop)
            : first(box, hop), second(box, hop), re(box - 1 + hop, 0.0), im(box - 1 + hop, 0.0)
        {
        }

        void reset() noexcept
        {
            first.reset();
            second.reset();
            std::fill(re.begin(), re.end(), 0.0);
            std::fill(im.begin(), im.end(), 0.0);
        }

        /// Delays one hop by buffer size - hop size frames.
        static void delay(std::span<double> values, std::vector<double>& buffer) noexcept
        {
            const std::size_t kept = buffer.size() - values.size();
            std::copy(values.begin(), values.end(), buffer.begin() + static_cast<std::ptrdiff_t>(kept));
            std::copy_n(buffer.begin(), values.size(), values.begin());
            std::copy(buffer.end() - static_cast<std::ptrdiff_t>(kept), buffer.end(), buffer.begin());
        }

        MovingAverage first;
        MovingAverage second;
        std::vector<double> re;
        std::vector<double> im;
    };

    std::size_t box;
    std::size_t hop;
    std::vector<double> magnitude;
    std::array<Pass, passCount> passes;
};

} // namespace pacini
