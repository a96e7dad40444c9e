#pragma once

// The translation "freqshift": the sound with copies one and two octaves lower, through the range where skin feels
// best.

#include <pacini/analysis/methods/MethodCurves.h>
#include <pacini/analysis/methods/MethodSound.h>
#include <pacini/filters/Butterworth.h>
#include <pacini/filters/Resampler.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Fft.h>
#include <pacini/foundation/Windows.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

namespace detail
{

/// The sound `octaves` lower and as long as it was: made shorter by a phase vocoder (J. Flanagan and R. Golden, "Phase
/// Vocoder", 1966; windows of 46 ms, a quarter apart), then read as much slower. Every bin turns on its own, so attacks
/// smear over a window: that is part of this translation, unlike pitchShift().
[[nodiscard]] inline std::vector<float> shortenedAndSlowed(std::span<const float> mono, double fs, int octaves)
{
    const std::size_t window = roundedFrames(powerOfTwoFrames(fs).window, fs);
    const std::size_t hop = window / 4;
    const std::size_t rate = std::size_t{1} << octaves;
    const std::vector<double> hann = hannPeriodic(window);
    RealFft<double> forward(window);
    ComplexFft<double> inverse(window);
    const std::size_t bins = forward.bins();
    std::vector<double> frame(window);
    std::vector<std::complex<double>> now(bins), next(bins), turned(window), output(window);
    std::vector<double> phase(bins, 0.0);
    const auto analyse = [&](std::size_t centre, std::vector<std::complex<double>>& spectrum)
    {
        for (std::size_t i = 0; i < window; ++i)
        {
            const std::size_t at = centre + i; // half a window later than the sample
            const bool inside = at >= window / 2 && at - window / 2 < mono.size();
            frame[i] = inside ? hann[i] * finiteOrZero(mono[at - window / 2]) : 0.0;
        }
        forward.forward(frame, spectrum);
    };
    const std::size_t length = (mono.size() + rate - 1) / rate;
    std::vector<double> sum(length + 2 * window, 0.0), weight(sum.size(), 0.0);
    for (std::size_t k = 0; k * hop < length + window / 2; ++k)
    {
        analyse(rate * k * hop, now);
        analyse(rate * k * hop + hop, next);
        for (std::size_t b = 0; b < bins; ++b)
        {
            if (k == 0)
                phase[b] = std::arg(now[b]);
            turned[b] = std::polar(std::abs(now[b]), phase[b]);
            if (b > 0 && b < bins - 1)
                turned[window - b] = std::conj(turned[b]);
            phase[b] = std::remainder(phase[b] + std::arg(next[b]) - std::arg(now[b]), 2.0 * std::numbers::pi);
        }
        inverse.inverse(turned, output);
        for (std::size_t i = 0; i < window; ++i)
        {
            sum[k * hop + i] += hann[i] * output[i].real() / static_cast<double>(window);
            weight[k * hop + i] += hann[i] * hann[i];
        }
    }
    std::vector<float> shorter(length);
    for (std::size_t n = 0; n < length; ++n)
        shorter[n] = toSample(sum[n + window / 2] / std::max(1e-9, weight[n + window / 2]));
    auto slower = resample(std::span<const float>(shorter), 8000, 8000 * static_cast<int>(rate));
    std::vector<float> result = slower ? std::move(slower).value() : std::vector<float>{};
    result.resize(mono.size());
    return result;
}

} // namespace detail

/// The sound, its copies 12 and 24 semitones lower, their sum scaled to half of full power, a high-pass at 10 Hz and a
/// band-pass of 125 to 375 Hz, and clipping (R. Okazaki, H. Kuribayashi and H. Kajimoto, "The Effect of Frequency
/// Shifting on Audio-Tactile Conversion for Enriching Musical Experience", Haptic Interaction 2015, as Y. Li and H.
/// Seifi used it in "Sound2Hap", CHI 2026). The filters are causal, as theirs. As long as the input; fs is 8000 to
/// 768000 Hz; NaN and infinities count as 0.
[[nodiscard]] inline std::vector<float> frequencyShift(std::span<const float> mono, double fs)
{
    std::vector<float> sum(mono.begin(), mono.end());
    if (!(normalise(sum) > 0.0))
        return sum;
    const std::vector<float> octave = detail::shortenedAndSlowed(sum, fs, 1);
    const std::vector<float> twoOctaves = detail::shortenedAndSlowed(sum, fs, 2);
    double power = 0.0;
    for (std::size_t n = 0; n < sum.size(); ++n)
    {
        sum[n] += octave[n] + twoOctaves[n];
        power += static_cast<double>(sum[n]) * static_cast<double>(sum[n]);
    }
    const double scale = power > 0.0 ? std::sqrt(0.5 * static_cast<double>(sum.size()) / power) : 0.0;
    for (float& x : sum)
        x = toSample(scale * static_cast<double>(x));
    for (const ButterworthParams& params :
         {ButterworthParams{ButterworthType::highpass, 2, Hertz(10.0), {}},
          ButterworthParams{ButterworthType::bandpass, 4, Hertz(125.0), Hertz(375.0)}})
    {
        Butterworth filter;
        filter.prepare({fs, sum.size()});
        filter.setParams(params);
        filter.process(sum, sum);
    }
    for (float& x : sum)
        x = std::clamp(x, -1.0f, 1.0f);
    return sum;
}

} // namespace pacini
