#pragma once

// Overlap-add of an analytic signal at a low rate, read as smoothed frames.

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

/// Window-weighted means of an analytic signal z around one moment.
struct AnalyticFrame
{
    double magnitude = 0.0;        ///< of |z|
    double power = 0.0;            ///< of |z|^2
    double peakPower = 0.0;        ///< largest |z|^2 under the window
    std::complex<double> rotation; ///< of conj(z[n]) z[n + 1]: its angle is the power-weighted mean frequency
};

/// The means to compute. The others stay 0, since a square root or four products per sample count.
enum class FrameContent
{
    magnitude,
    powerAndRotation
};

/// Adds up blocks of an analytic signal and hands out frames in order as soon as no later block can change them.
class AnalyticTrack
{
public:
    /// Frames are `step` seconds apart, which must be a multiple of half a sample at `rate` Hz. A Hann window of
    /// `window` seconds weights the samples around each.
    AnalyticTrack(int rate, double window, double step)
        : samplesPerSecond(rate), halfSamplesPerFrame(static_cast<std::int64_t>(std::llround(2.0 * step * rate)))
    {
        const double half = 0.5 * window * rate;
        reach = static_cast<std::int64_t>(std::ceil(half));
        for (std::size_t p = 0; p < 2; ++p) // frames stand on a sample or half-way between two
        {
            const double centre = static_cast<double>(reach) + 0.5 * static_cast<double>(p);
            std::vector<double> kernel(static_cast<std::size_t>(2 * reach + 2));
            double sum = 0.0;
            for (std::size_t i = 0; i < kernel.size(); ++i)
            {
                const double u = (static_cast<double>(i) - centre) / half;
                kernel[i] = std::abs(u) < 1.0 ? 0.5 + 0.5 * std::cos(std::numbers::pi * u) : 0.0;
                sum += kernel[i];
            }
            for (double v : kernel)
                kernels[p].push_back(static_cast<float>(v / sum));
        }
    }

    [[nodiscard]] int rate() const noexcept { return samplesPerSecond; }

    void reset() noexcept
    {
        samples.clear();
        start = 0;
        nextFrame = 0;
    }

    /// Adds a block, real and imaginary parts of one length, whose first sample is number `position` (negative before
    /// the sound's start).
    void add(std::int64_t position, std::span<const float> re, std::span<const float> im)
    {
        if (samples.empty())
            start = std::min(start, position);
        const auto offset = static_cast<std::size_t>(position - start);
        if (samples.size() < offset + re.size())
            samples.resize(offset + re.size());
        for (std::size_t i = 0; i < re.size(); ++i)
            samples[offset + i] += std::complex(re[i], im[i]);
    }

    /// Calls `emit(AnalyticFrame)` for every frame whose window ends before sample number `complete`, at most up to
    /// frame number `frames` (exclusive). Samples after the last block count as silence.
    template <FrameContent content, typename Emit>
    void drain(std::int64_t complete, std::int64_t frames, Emit&& emit)
    {
        for (; nextFrame < frames && firstSample() + 2 * reach + 3 <= complete; ++nextFrame)
            emit(
                smooth<content>(firstSample(), kernels[static_cast<std::size_t>(nextFrame * halfSamplesPerFrame & 1)]));
        const std::int64_t unused = std::min(firstSample() - start, static_cast<std::int64_t>(samples.size()));
        if (unused > 0)
        {
            samples.erase(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(unused));
            start += unused;
        }
    }

private:
    /// The first sample under the window of the next frame.
    [[nodiscard]] std::int64_t firstSample() const noexcept { return nextFrame * halfSamplesPerFrame / 2 - reach; }

    template <FrameContent content>
    [[nodiscard]] AnalyticFrame smooth(std::int64_t first, std::span<const float> kernel) const noexcept
    {
        AnalyticFrame frame;
        const auto size = static_cast<std::int64_t>(samples.size());
        const std::int64_t from = std::max<std::int64_t>(first - start, 0);
        const std::int64_t to = std::min(first - start + static_cast<std::int64_t>(kernel.size()), size - 1);
        for (std::int64_t at = from; at < to; ++at)
        {
            const auto z = samples[static_cast<std::size_t>(at)];
            const float w = kernel[static_cast<std::size_t>(at - (first - start))];
            const float power = z.real() * z.real() + z.imag() * z.imag();
            if constexpr (content == FrameContent::magnitude)
            {
                frame.magnitude += static_cast<double>(w * std::sqrt(power));
                frame.peakPower = std::max(frame.peakPower, static_cast<double>(power));
            }
            else
            {
                const auto next = samples[static_cast<std::size_t>(at) + 1];
                frame.power += static_cast<double>(w * power);
                frame.rotation +=
                    std::complex<double>(static_cast<double>(w * (z.real() * next.real() + z.imag() * next.imag())),
                                         static_cast<double>(w * (z.real() * next.imag() - z.imag() * next.real())));
            }
        }
        return frame;
    }

    int samplesPerSecond;
    std::int64_t halfSamplesPerFrame;
    std::int64_t reach = 0;
    std::array<std::vector<float>, 2> kernels;
    std::vector<std::complex<float>> samples;
    std::int64_t start = 0; // number of the first kept sample
    std::int64_t nextFrame = 0;
};

} // namespace pacini
