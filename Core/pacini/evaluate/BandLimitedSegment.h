#pragma once

// Zero-phase band-pass of one piece of a signal: 30 to 1000 Hz, as spectrum and as samples.

#include <pacini/evaluate/AnalyticBand.h>
#include <pacini/evaluate/Segmentation.h>
#include <pacini/foundation/SplitRealFft.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Sums of squares of a signal, of its band-limited part and of the rest.
struct BandLimitEnergies
{
    double total = 0.0;
    double inside = 0.0;
    double outside = 0.0;
};

/// Limits segments of one size to a band by a zero-phase Butterworth band-pass of order 4; transforms are planned once.
class BandLimitedSegment
{
public:
    /// For segments of `size` samples (even, no prime factor above 5) at the rate fs and the band f1 .. f2, all in Hz.
    BandLimitedSegment(std::size_t size, double fs, double f1, double f2)
        : forward(size),
          backward(size),
          gains(forward.bins()),
          time(size),
          fullSpectrum(forward.bins()),
          limitedSpectrum(forward.bins()),
          limited(size)
    {
        for (std::size_t k = 0; k < gains.size(); ++k)
            gains[k] = zeroPhaseBandpass(fs * static_cast<double>(k) / static_cast<double>(size), f1, f2, 4);
    }

    /// Takes the samples of `x` around segment.coreBegin .. segment.coreEnd, times `gain`; silence outside x, and for
    /// samples that are not finite. Adds the energies of the core.
    template <typename Sample>
    void load(std::span<const Sample> x, const Segment& segment, double gain, BandLimitEnergies& energies) noexcept
    {
        copySegment(x, segment, gain, std::span(time));
        // The forward transform runs in double precision: what is in band may be far weaker than what is not.
        forward.forward(time.data(), fullSpectrum.re.data(), fullSpectrum.im.data());
        for (std::size_t k = 0; k < gains.size(); ++k)
        {
            limitedSpectrum.re[k] = static_cast<float>(gains[k] * fullSpectrum.re[k]);
            limitedSpectrum.im[k] = static_cast<float>(gains[k] * fullSpectrum.im[k]);
        }
        backward.inverse(limitedSpectrum.re.data(), limitedSpectrum.im.data(), limited.data());
        const float scale = 1.0f / static_cast<float>(limited.size());
        for (float& v : limited)
            v *= scale;
        for (std::size_t i = segment.localIndex(segment.coreBegin); i < segment.localIndex(segment.coreEnd); ++i)
        {
            const auto inside = static_cast<double>(limited[i]);
            const double rest = time[i] - inside;
            energies.total += time[i] * time[i];
            energies.inside += inside * inside;
            energies.outside += rest * rest;
        }
    }

    /// Silences the samples (not the spectrum) outside 0 .. length - 1 of the signal.
    void cutSamples(const Segment& segment, std::size_t length) noexcept
    {
        const auto size = static_cast<std::ptrdiff_t>(limited.size());
        const auto begin = std::clamp<std::ptrdiff_t>(-segment.begin, 0, size);
        const auto end = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(length) - segment.begin, 0, size);
        std::fill(limited.begin(), limited.begin() + begin, 0.0f);
        std::fill(limited.begin() + end, limited.end(), 0.0f);
    }

    /// The unscaled transform of the band-limited segment, bins 0 .. size / 2.
    [[nodiscard]] const SplitArray<float>& spectrum() const noexcept { return limitedSpectrum; }

    /// The band-limited segment.
    [[nodiscard]] std::span<const float> samples() const noexcept { return limited; }

private:
    SplitRealFft<double> forward;
    SplitRealFft<float> backward;
    std::vector<double> gains; // of the bins
    std::vector<double> time;  // the segment as it came
    SplitArray<double> fullSpectrum;
    SplitArray<float> limitedSpectrum;
    std::vector<float> limited;
};

} // namespace pacini
