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

/// A signal that comes in hops of one fixed length, with as much of its past as is wanted in one piece before it. There
/// is room for some hops, so that the past seldom has to be moved.
class HopHistory
{
public:
    HopHistory(std::size_t pastFrames, std::size_t hopFrames)
        : past(pastFrames), hop(hopFrames), buffer(past + hops * hop, 0.0), next(past)
    {
    }

    void reset() noexcept { std::fill(buffer.begin(), buffer.end(), 0.0); }

    /// Returns the place for the values of the next hop; the past lies before it.
    [[nodiscard]] double* nextHop() noexcept
    {
        if (next + hop > buffer.size())
        {
            std::copy(buffer.begin() + static_cast<std::ptrdiff_t>(next - past),
                      buffer.begin() + static_cast<std::ptrdiff_t>(next), buffer.begin());
            next = past;
        }
        double* const place = buffer.data() + next;
        next += hop;
        return place;
    }

    /// Takes the next hop and returns it delayed by its past.
    [[nodiscard]] const double* delayed(std::span<const double> values) noexcept
    {
        assert(values.size() == hop);
        double* const place = nextHop();
        std::copy(values.begin(), values.end(), place);
        return place - past;
    }

private:
    static constexpr std::size_t hops = 4;

    std::size_t past;
    std::size_t hop;
    std::vector<double> buffer;
    std::size_t next; ///< where the next hop begins
};

/// A moving average in hops of one fixed length. The sum is recomputed for each hop, so that rounding errors do not
/// accumulate.
class MovingAverage
{
public:
    MovingAverage(std::size_t window, std::size_t hopFrames) : length(window), history(window - 1, hopFrames) {}

    void reset() noexcept { history.reset(); }

    /// values[n] becomes the mean of the `window` newest values up to n. `values` has the length of a hop.
    void process(std::span<double> values) noexcept
    {
        Hop hop(*this);
        for (double& value : values)
            value = hop.follow(value);
    }

    /// Processes both by turns: neither has to wait until the other is done with the hop.
    static void process(MovingAverage& first, MovingAverage& second, std::span<double> values) noexcept
    {
        Hop hop(first), next(second);
        for (double& value : values)
            value = next.follow(hop.follow(value));
    }

private:
    /// A hop on its way.
    class Hop
    {
    public:
        explicit Hop(MovingAverage& average) noexcept
            : scale(1.0 / static_cast<double>(average.length)),
              newest(average.history.nextHop()),
              oldest(newest - (average.length - 1))
        {
            for (const double* value = oldest; value != newest; ++value)
                sum += *value;
        }

        double follow(double value) noexcept
        {
            *newest++ = value;
            sum += value;
            const double mean = std::max(sum, 0.0) * scale;
            sum -= *oldest++;
            return mean;
        }

    private:
        double scale;
        double* newest;
        const double* oldest;
        double sum = 0.0;
    };

    std::size_t length;
    HopHistory history;
};

/// One part of a signal, as analytic signal.
struct LevelledPart
{
    std::span<double> re, im;
    std::span<double> share = {}; ///< what of `im` is to come out by itself, too; empty where nothing is
};

/// Envelope correction. Sinusoids that stand for bands beat against each other, which the source did not. The leveller
/// measures the magnitude of their analytic sum over a 10 ms window (a triangle, two moving averages) and scales it to
/// the wanted envelope: first each part of the signal by itself, then their sum, also because the first gain moves the
/// magnitude within the window. Beats slower than about 50 Hz vanish; faster ones, which carry roughness, stay. Works
/// in hops of a fixed length; output is delayed by latencyFrames().
class EnvelopeLeveller
{
public:
    static constexpr double window = 0.010;    ///< s, whole length of the triangle
    static constexpr double largestGain = 8.0; ///< beats are not filled deeper than 18 dB

    /// Frames are those of the decoder's inner rate `fs`; hops have `hopFrames` frames.
    EnvelopeLeveller(double fs, std::size_t hopFrames, std::size_t parts = 1, bool shares = false)
        : box(boxFrames(fs)), hop(hopFrames), magnitude(hopFrames), passes(parts + 1, Pass(box, hop, shares))
    {
        assert(parts > 0);
    }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return delayOfPass(passes.size() - 1); }

    void reset() noexcept
    {
        for (auto& pass : passes)
            pass.reset();
    }

    /// Levels one hop of each part and their sum, which is then in the first of `parts`; the same for shares, which all
    /// or none have. `target(k)` is the wanted envelope for this hop of part k, or of the sum where k is their number,
    /// delayOfPass(k) before the input.
    template <typename Target>
    void process(std::span<const LevelledPart> parts, Target&& target) noexcept
    {
        assert(parts.size() + 1 == passes.size());
        for (std::size_t k = 0; k < parts.size(); ++k)
            level(passes[k], parts[k], target(k));
        for (std::size_t k = 1; k < parts.size(); ++k)
            for (std::size_t n = 0; n < hop; ++n)
            {
                parts[0].re[n] += parts[k].re[n];
                parts[0].im[n] += parts[k].im[n];
            }
        for (std::size_t k = 1; k < parts.size(); ++k)
            for (std::size_t n = 0; n < parts[k].share.size(); ++n)
                parts[0].share[n] += parts[k].share[n];
        level(passes.back(), parts[0], target(parts.size()));
    }

    /// Frames by which what pass k puts out is delayed: half a window in all parts, another one in their sum.
    [[nodiscard]] std::size_t delayOfPass(std::size_t k) const noexcept
    {
        return (k + 1 < passes.size() ? 1 : 2) * (box - 1);
    }

private:
    static constexpr double tiny = 1e-5; // -100 dB: silence stays silence

    static std::size_t boxFrames(double fs) { return static_cast<std::size_t>(std::lround(0.5 * window * fs)) | 1u; }

    struct Pass
    {
        Pass(std::size_t box, std::size_t hop, bool shares)
            : first(box, hop),
              second(box, hop),
              re(box - 1, hop),
              im(box - 1, hop),
              share(shares ? box - 1 : 0, shares ? hop : 0)
        {
        }

        void reset() noexcept
        {
            first.reset();
            second.reset();
            re.reset();
            im.reset();
            share.reset();
        }

        MovingAverage first;
        MovingAverage second;
        HopHistory re; ///< delayed as the averages are
        HopHistory im;
        HopHistory share;
    };

    void level(Pass& pass, const LevelledPart& part, std::span<const double> wanted) noexcept
    {
        const auto& re = part.re;
        const auto& im = part.im;
        for (std::size_t n = 0; n < hop; ++n)
            magnitude[n] = std::sqrt(re[n] * re[n] + im[n] * im[n]);
        MovingAverage::process(pass.first, pass.second, magnitude);
        const double* const delayedRe = pass.re.delayed(re);
        const double* const delayedIm = pass.im.delayed(im);
        for (std::size_t n = 0; n < hop; ++n)
        {
            const double gain = std::min((wanted[n] + tiny) / (magnitude[n] + tiny), largestGain);
            re[n] = delayedRe[n] * gain;
            im[n] = delayedIm[n] * gain;
        }
        if (!part.share.empty())
            levelShare(pass, part.share, wanted);
    }

    /// By the gains of the whole.
    void levelShare(Pass& pass, std::span<double> share, std::span<const double> wanted) const noexcept
    {
        const double* const delayed = pass.share.delayed(share);
        for (std::size_t n = 0; n < hop; ++n)
            share[n] = delayed[n] * std::min((wanted[n] + tiny) / (magnitude[n] + tiny), largestGain);
    }

    std::size_t box;
    std::size_t hop;
    std::vector<double> magnitude;
    std::vector<Pass> passes;
};

} // namespace pacini
