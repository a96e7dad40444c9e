#pragma once

// Noise spectrum of a recording while nothing is played.

#include <pacini/foundation/SplitRealFft.h>
#include <pacini/foundation/Windows.h>
#include <pacini/linearize/RecordedChannels.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// The power of a channel's noise at each frequency as E|FFT|^2 of n samples, divided by n.
class NoiseSpectrum
{
public:
    /// From the quiet times `spans` (begin and end in s of the recording) of channel `c`: P. Welch, "The use of fast
    /// Fourier transform for the estimation of power spectra", 1967, Hann windows that overlap by half; up to
    /// half of a second long, not longer than the longest span. All 0 without a span of 16 frames.
    NoiseSpectrum(const RecordedChannels& recording, std::size_t c, std::span<const std::pair<double, double>> spans)
        : rate(recording.rate)
    {
        double longest = 0.0;
        for (const auto& [begin, end] : spans)
            longest = std::max(longest, end - begin);
        const auto wanted = static_cast<std::size_t>(std::min(0.5, longest) * rate);
        if (wanted < 16)
            return;
        const std::size_t n = std::bit_floor(wanted);
        SplitRealFft<double> fft(n);
        const auto window = hannPeriodic(n);
        double energy = 0.0;
        for (const double w : window)
            energy += w * w;
        power.assign(fft.bins(), 0.0);
        std::vector<double> re(fft.bins());
        std::vector<double> im(fft.bins());
        std::size_t pieces = 0;
        for (const auto& [begin, end] : spans)
            for (auto first = static_cast<std::ptrdiff_t>(std::ceil(begin * rate));
                 first + static_cast<std::ptrdiff_t>(n) <= static_cast<std::ptrdiff_t>(end * rate);
                 first += static_cast<std::ptrdiff_t>(n / 2))
            {
                auto samples = recording.part(c, first, n);
                for (std::size_t i = 0; i < n; ++i)
                    samples[i] *= window[i];
                fft.forward(samples.data(), re.data(), im.data());
                for (std::size_t k = 0; k < power.size(); ++k)
                    power[k] += (re[k] * re[k] + im[k] * im[k]) / energy;
                ++pieces;
            }
        for (double& p : power)
            p /= static_cast<double>(std::max<std::size_t>(1, pieces));
    }

    /// The power at f Hz; the lowest two bins hold what the mean left and count as the third.
    [[nodiscard]] double at(double f) const noexcept
    {
        if (power.size() < 4)
            return 0.0;
        const double bin = f / rate * static_cast<double>(2 * (power.size() - 1));
        const double position = std::clamp(bin, 2.0, static_cast<double>(power.size() - 2));
        const auto k = static_cast<std::size_t>(position);
        return power[k] + (power[k + 1] - power[k]) * (position - static_cast<double>(k));
    }

private:
    double rate;
    std::vector<double> power;
};

} // namespace pacini
