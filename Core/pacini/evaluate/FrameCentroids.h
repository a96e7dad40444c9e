#pragma once

// Power and spectral centroid of short frames.

#include <pacini/evaluate/FrameSpectra.h>
#include <pacini/foundation/DotProduct.h>
#include <pacini/foundation/Windows.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Power (in an arbitrary but fixed unit) and centroid (Hz, 0 for silence) of the bins from 30 to 1000 Hz of 64 ms Hann
/// frames, in bins of 7.8125 Hz.
class FrameCentroids
{
public:
    struct Frame
    {
        float power = 0.0f;
        float centroid = 0.0f;
    };
    static constexpr std::size_t fineSize = 512;            ///< samples of a frame at 8 kHz
    static constexpr std::size_t coarseSize = fineSize / 2; ///< samples of a frame at 4 kHz

    FrameCentroids()
        : coarseSpectra(hannPeriodic(coarseSize), 2 * coarseSize), fineSpectra(hannPeriodic(fineSize), 2 * fineSize)
    {
        constexpr float binWidth = 8000.0f / (2.0f * fineSize);
        constexpr std::size_t lastBin = 128; // 1000 Hz
        for (std::size_t k = firstBin; k <= lastBin; ++k)
            frequencies.push_back(binWidth * static_cast<float>(k));
        ones.assign(frequencies.size(), 1.0f);
        powers.fill(ones);
    }

    /// Two frames of coarseSize samples at 4 kHz: enough as long as nothing above 2 kHz leaks below 1 kHz, that is, as
    /// long as the signal has no edge inside the frame.
    [[nodiscard]] std::array<Frame, 2> coarse(std::span<const float> a, std::span<const float> b) noexcept
    {
        coarseSpectra.power(a, b, firstBin, powers[0], powers[1]);
        constexpr float scale = 4.0f; // half as many samples make half the amplitude
        return {measured(powers[0], scale), measured(powers[1], scale)};
    }

    /// One frame of fineSize samples at 8 kHz.
    [[nodiscard]] Frame fine(std::span<const float> x) noexcept
    {
        fineSpectra.power(x, x, firstBin, powers[0], powers[1]);
        return measured(powers[0], 1.0f);
    }

private:
    static constexpr std::size_t firstBin = 4; // 31.25 Hz, the first from 30 Hz on

    [[nodiscard]] Frame measured(std::span<const float> power, float scale) const noexcept
    {
        const float sum = dotProduct(power.data(), ones.data(), power.size());
        const float moment = dotProduct(power.data(), frequencies.data(), power.size());
        return {scale * sum, sum > 0.0f ? moment / sum : 0.0f};
    }

    FrameSpectra coarseSpectra;
    FrameSpectra fineSpectra;
    std::array<std::vector<float>, 2> powers;
    std::vector<float> ones;
    std::vector<float> frequencies; // of the bins, Hz
};

} // namespace pacini
