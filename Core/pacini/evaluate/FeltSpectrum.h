#pragma once

// Short-time spectra in the resolution of touch.

#include <pacini/evaluate/FrameSpectra.h>
#include <pacini/evaluate/HtsFeatures.h>
#include <pacini/foundation/DotProduct.h>
#include <pacini/foundation/Windows.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Amplitudes in 21 bands from 25 Hz whose edges have the ratio 1.2 (the just noticeable difference of frequency),
/// smeared over two bands on each side by [1 2 3 2 1] / 9, for 512-sample Hann frames at hop 256 of signals at 4 kHz.
class FeltSpectrumAnalyzer
{
public:
    using Frame = std::array<float, HtsFeatures::spectrumCount>;

    FeltSpectrumAnalyzer() : spectra(hannPeriodic(frameSize), frameSize)
    {
        constexpr double binWidth = static_cast<double>(HtsFeatures::sampleRate) / frameSize;
        for (std::size_t b = 0; b < bands.size(); ++b)
        {
            const double low = 25.0 * std::pow(1.2, static_cast<double>(b)) / binWidth;
            const double high = 1.2 * low;
            bands[b].firstBin = static_cast<std::size_t>(low + 0.5);
            for (std::size_t k = bands[b].firstBin; static_cast<double>(k) - 0.5 < high; ++k)
            {
                // The share of the bin's width that lies in the band.
                const double centre = static_cast<double>(k);
                const double share = std::min(high, centre + 0.5) - std::max(low, centre - 0.5);
                bands[b].weights.push_back(static_cast<float>(std::clamp(share, 0.0, 1.0)));
            }
        }
        for (auto& power : powers)
            power.resize(bands.back().firstBin + bands.back().weights.size() - bands.front().firstBin);
    }

    /// Returns the frames that cover x, at least one; x is silent after its end.
    [[nodiscard]] std::vector<Frame> analyze(std::span<const float> x)
    {
        const std::size_t count = x.size() <= frameSize ? 1 : (x.size() - frameSize + hop - 1) / hop + 1;
        std::vector<Frame> result;
        for (std::size_t m = 0; m < count; m += 2)
        {
            for (std::size_t i = 0; i < 2; ++i)
            {
                const auto part = x.subspan(std::min((m + i) * hop, x.size()));
                const auto rest = std::copy_n(part.begin(), std::min(part.size(), frameSize), frames[i].begin());
                std::fill(rest, frames[i].end(), 0.0f);
            }
            spectra.power(frames[0], frames[1], bands.front().firstBin, powers[0], powers[1]);
            for (std::size_t i = 0; i < 2 && m + i < count; ++i)
                result.push_back(smeared(powers[i]));
        }
        return result;
    }

private:
    static constexpr std::size_t frameSize = 512;
    static constexpr std::size_t hop = 256;

    struct BandWeights
    {
        std::size_t firstBin = 0;
        std::vector<float> weights;
    };

    [[nodiscard]] Frame smeared(std::span<const float> power) const noexcept
    {
        constexpr std::array<float, 5> kernel{1.0f / 9.0f, 2.0f / 9.0f, 3.0f / 9.0f, 2.0f / 9.0f, 1.0f / 9.0f};
        constexpr float scale = 1.0f / (0.375f * frameSize * frameSize / 2.0f);
        std::array<float, HtsFeatures::spectrumCount + 4> sums{}; // two silent bands on each side
        for (std::size_t b = 0; b < bands.size(); ++b)
            sums[b + 2] =
                dotProduct(bands[b].weights.data(), power.data() + (bands[b].firstBin - bands.front().firstBin),
                           bands[b].weights.size());
        Frame frame;
        for (std::size_t b = 0; b < frame.size(); ++b)
            frame[b] = std::sqrt(dotProduct(kernel.data(), sums.data() + b, kernel.size()) * scale);
        return frame;
    }

    FrameSpectra spectra;
    std::array<BandWeights, HtsFeatures::spectrumCount> bands;
    std::array<std::vector<float>, 2> frames{std::vector<float>(frameSize), std::vector<float>(frameSize)};
    std::array<std::vector<float>, 2> powers;
};

} // namespace pacini
