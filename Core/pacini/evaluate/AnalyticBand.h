#pragma once

// Analytic signals of zero-phase Butterworth bands, sampled only as often as their envelopes need.

#include <pacini/foundation/SplitFft.h>
#include <pacini/foundation/SplitRealFft.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace pacini
{

/// Amplitude response at `f` of an analogue Butterworth band-pass of order `order` between f1 and f2 (Hz, 0 < f1 < f2)
/// that runs forward and backward: 1 / (1 + q^(2 order)), q = (f^2 - f1 f2) / (f (f2 - f1)). -6 dB at both edges, no
/// phase shift; 0 at and below 0 Hz. (S. Butterworth, "On the theory of filter amplifiers", 1930, with the standard
/// low-pass to band-pass substitution.)
[[nodiscard]] inline double zeroPhaseBandpass(double f, double f1, double f2, int order) noexcept
{
    if (!(f > 0.0))
        return 0.0;
    const double q = (f * f - f1 * f2) / (f * (f2 - f1));
    const double squared = q * q;
    double power = squared;
    for (int i = 1; i < order; ++i)
        power *= squared;
    return 1.0 / (1.0 + power);
}

/// The inverse transforms of all sizes that an analysis needs, each planned once.
class InverseTransforms
{
public:
    SplitFft<float>& operator[](std::size_t size)
    {
        auto found = plans.find(size);
        if (found == plans.end())
            found = plans.emplace(size, SplitFft<float>(size)).first;
        return found->second;
    }

private:
    std::map<std::size_t, SplitFft<float>> plans;
};

/// Turns the spectrum of a real signal into the analytic signal of one band at a lower rate: inverse transform of fewer
/// bins. Bins beyond the new size fold onto others, which is what makes the output the exact samples of the analytic
/// signal; only its magnitude must be slow enough for the rate. The transform runs in single precision: its noise is
/// 130 dB below the band's own peak, whatever is in other bands.
class AnalyticBand
{
public:
    AnalyticBand() = default;

    /// For transforms of `size` samples, of which the output has `outputCount` at equal distances (at most size,
    /// without prime factors above 5). `gains` holds the amplitude response from bin `firstBin` on; other bins count as
    /// 0. Bins are 0 .. size / 2.
    AnalyticBand(std::size_t size, std::size_t outputCount, std::size_t firstBin, std::vector<float> gains)
        : outputs(outputCount), first(firstBin), weights(std::move(gains))
    {
        for (std::size_t i = 0; i < weights.size(); ++i)
        {
            const std::size_t bin = first + i;
            weights[i] *= (bin == 0 || 2 * bin == size ? 1.0f : 2.0f) / static_cast<float>(size);
        }
    }

    /// The band f1 .. f2 Hz of zeroPhaseBandpass() at the sample rate fs, as far as it is above 1e-5 (-100 dB).
    static AnalyticBand butterworth(std::size_t size, std::size_t outputCount, double fs, double f1, double f2,
                                    int order)
    {
        const double reach = std::pow(1e5 - 1.0, 0.5 / order) * (f2 - f1); // |q| of the limit times bandwidth
        const double root = std::sqrt(reach * reach + 4.0 * f1 * f2);
        const double bin = fs / static_cast<double>(size);
        const auto low = static_cast<std::size_t>((root - reach) / 2.0 / bin);
        const auto high = std::min(size / 2, static_cast<std::size_t>((root + reach) / 2.0 / bin) + 1);
        std::vector<float> gains(high - low + 1);
        for (std::size_t k = low; k <= high; ++k)
            gains[k - low] = static_cast<float>(zeroPhaseBandpass(static_cast<double>(k) * bin, f1, f2, order));
        return {size, outputCount, low, std::move(gains)};
    }

    /// Number of output samples of one transform.
    [[nodiscard]] std::size_t outputCount() const noexcept { return outputs; }

    /// The analytic signal at the samples j * size / outputCount, j = 0 .. outputCount - 1, in `out`. `spectrum` is the
    /// unscaled transform of the real signal (bins 0 .. size / 2); `scratch` and `out` have room for outputCount
    /// numbers.
    template <typename Real>
    void sample(const SplitArray<Real>& spectrum, InverseTransforms& transforms, SplitArray<float>& scratch,
                SplitArray<float>& out) const
    {
        std::fill_n(scratch.re.begin(), outputs, 0.0f);
        std::fill_n(scratch.im.begin(), outputs, 0.0f);
        std::size_t target = first % outputs;
        for (std::size_t done = 0; done < weights.size();)
        {
            const std::size_t count = std::min(weights.size() - done, outputs - target);
            for (std::size_t i = 0; i < count; ++i)
            {
                const float weight = weights[done + i];
                scratch.re[target + i] += weight * static_cast<float>(spectrum.re[first + done + i]);
                scratch.im[target + i] += weight * static_cast<float>(spectrum.im[first + done + i]);
            }
            done += count;
            target = 0;
        }
        transforms[outputs].inverse(scratch.re.data(), scratch.im.data(), out.re.data(), out.im.data());
    }

private:
    std::size_t outputs = 0;
    std::size_t first = 0;
    std::vector<float> weights;
};

} // namespace pacini
