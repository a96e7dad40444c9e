#pragma once

// The translation "pitch-shift": the whole sound, some octaves lower and just as long.

#include <pacini/analysis/methods/MethodCurves.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Fft.h>
#include <pacini/foundation/Units.h>
#include <pacini/foundation/Windows.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Parameters of "pitch-shift".
struct PitchShiftParams
{
    double semitones = -24.0; ///< clamped to -60 to 24
    bool operator==(const PitchShiftParams&) const = default;
};

namespace detail
{

/// Shifts the spectrum of one frame after another.
class PeakShifter
{
public:
    /// Frames of `window` samples, `hop` apart, transformed at twice their length; frequencies change by `ratio`.
    PeakShifter(std::size_t window, std::size_t hop, double frequencyRatio)
        : hopFrames(static_cast<double>(hop)),
          ratio(frequencyRatio),
          forward(2 * window),
          inverse(2 * window),
          spectrum(forward.bins()),
          before(forward.bins()),
          power(forward.bins()),
          turn(forward.bins()),
          shifted(2 * window),
          output(2 * window)
    {
    }

    [[nodiscard]] std::size_t size() const noexcept { return inverse.size(); }

    /// Transforms a windowed frame whose middle is at index 0 (the first half at the end). Returns the shifted frame in
    /// the same layout, to be read as real parts.
    std::span<const std::complex<double>> process(std::span<const double> frame)
    {
        std::swap(spectrum, before);
        forward.forward(frame, spectrum);
        std::transform(spectrum.begin(), spectrum.end(), power.begin(),
                       [](std::complex<double> v) { return std::norm(v); });
        findPeaks();
        std::fill(shifted.begin(), shifted.end(), 0.0);
        std::size_t begin = 0;
        for (std::size_t i = 0; i < peaks.size(); ++i)
        {
            const std::size_t end = i + 1 < peaks.size() ? valleyBetween(peaks[i], peaks[i + 1]) : power.size();
            shiftRegion(begin, peaks[i], end);
            begin = end;
        }
        inverse.inverse(shifted, output);
        return output;
    }

private:
    /// A peak is larger than the bins within half a main lobe of the Hann window on either side.
    void findPeaks()
    {
        constexpr std::size_t reach = 4;
        peaks.clear();
        for (std::size_t k = 0; k < power.size(); ++k)
        {
            bool largest = power[k] > 0.0;
            for (std::size_t d = 1; d <= reach && largest; ++d)
                largest = (k < d || power[k] > power[k - d]) && (k + d >= power.size() || power[k] >= power[k + d]);
            if (largest)
                peaks.push_back(k);
        }
    }

    [[nodiscard]] std::size_t valleyBetween(std::size_t a, std::size_t b) const
    {
        const auto from = power.begin() + static_cast<std::ptrdiff_t>(a);
        return static_cast<std::size_t>(std::min_element(from, power.begin() + static_cast<std::ptrdiff_t>(b)) -
                                        power.begin());
    }

    /// The frequency of a peak in bins, from how far its phase went since the frame before; 0 for the bin at 0 Hz.
    [[nodiscard]] double frequencyOf(std::size_t peak, double binAngle) const
    {
        if (peak == 0)
            return 0.0;
        const double expected = binAngle * static_cast<double>(peak) * hopFrames;
        const double turned = std::arg(spectrum[peak] * std::conj(before[peak]));
        const double offset = std::remainder(turned - expected, 2.0 * std::numbers::pi) / hopFrames / binAngle;
        return static_cast<double>(peak) + clampTo(offset, -1.0, 1.0); // a steady peak is at most half a bin off
    }

    void shiftRegion(std::size_t begin, std::size_t peak, std::size_t end)
    {
        const double binAngle = 2.0 * std::numbers::pi / static_cast<double>(size());
        const double shift = (ratio - 1.0) * frequencyOf(peak, binAngle);
        const double phase = std::remainder(turn[peak] + shift * binAngle * hopFrames, 2.0 * std::numbers::pi);
        std::fill(turn.begin() + static_cast<std::ptrdiff_t>(begin), turn.begin() + static_cast<std::ptrdiff_t>(end),
                  phase);

        const std::complex<double> rotation = std::polar(2.0, phase);
        const auto bins = static_cast<std::int64_t>(std::round(shift));
        const auto half = static_cast<std::int64_t>(size() / 2);
        for (std::size_t k = begin; k < end; ++k)
        {
            const auto target = static_cast<std::int64_t>(k) + bins;
            if (target > half)
                break;
            // Bins count twice, for their mirror images too, which those at both ends do not have.
            const double weight = k == 0 || k == size() / 2 ? 0.5 : 1.0;
            // What passes 0 Hz goes on at negative frequencies: real parts put it where it belongs.
            shifted[static_cast<std::size_t>(target < 0 ? target + 2 * half : target)] +=
                weight * rotation * spectrum[k];
        }
    }

    double hopFrames;
    double ratio;
    RealFft<double> forward;
    ComplexFft<double> inverse;
    std::vector<std::complex<double>> spectrum;
    std::vector<std::complex<double>> before; // the spectrum of the frame before
    std::vector<double> power;
    std::vector<double> turn; // by how much each bin has been rotated
    std::vector<std::complex<double>> shifted;
    std::vector<std::complex<double>> output;
    std::vector<std::size_t> peaks;
};

} // namespace detail

/// The signal with all its frequencies multiplied by 2^(semitones / 12) (Weber 2020, section 1.3: the first thing a
/// designer tries where a sound has nothing in the range of touch). A phase vocoder after J. Laroche and M. Dolson,
/// "New phase-vocoder techniques for pitch-shifting, harmonizing and other exotic effects", WASPAA 1999: every peak of
/// the spectrum moves to its new frequency with all bins around it, which turn by one phase, so that they stay locked.
/// Stretching the sound and resampling it would do as well for steady tones, but at -24 semitones it would smear each
/// onset over four windows; here it stays within one. Windows are 46 ms (Hann, applied before and after), a quarter
/// apart, transformed at twice their length, so that shifts by whole bins cost at most 0.2 dB; what they add to a
/// steady tone stays 50 dB below it (an eighth apart 75 dB, for twice the time). As long as the input; fs is 8000 to
/// 768000 Hz; NaN and infinities count as 0. What would land above half the sample rate is left out.
[[nodiscard]] inline std::vector<float> pitchShift(std::span<const float> mono, double fs,
                                                   const PitchShiftParams& params = {})
{
    const std::size_t window = roundedFrames(powerOfTwoFrames(fs).window, fs);
    const std::size_t hop = window / 4;
    const std::size_t half = window / 2;
    const std::vector<double> hann = hannPeriodic(window);
    detail::PeakShifter shifter(window, hop, std::exp2(clampTo(params.semitones, -60.0, 24.0) / 12.0));
    std::vector<double> frame(shifter.size(), 0.0);
    std::vector<double> sum(mono.size() + 2 * window, 0.0); // starts a window before the signal

    // The squares of the windows add up to 3/8 of their number per sample.
    const double scale = 1.0 / (0.375 * static_cast<double>(window / hop) * static_cast<double>(shifter.size()));
    for (std::size_t start = hop; start < mono.size() + window; start += hop)
    {
        // Element i of the window stands at sample start + i - window; its middle is at index 0 of the frame.
        const auto place = [&](std::size_t i)
        {
            return i < half ? i + shifter.size() - half : i - half;
        };
        for (std::size_t i = 0; i < window; ++i)
        {
            const std::size_t at = start + i;
            const bool inside = at >= window && at - window < mono.size();
            frame[place(i)] = inside ? hann[i] * finiteOrZero(mono[at - window]) : 0.0;
        }
        const auto out = shifter.process(frame);
        for (std::size_t i = 0; i < window; ++i)
            sum[start + i] += scale * hann[i] * out[place(i)].real();
    }
    std::vector<float> result(mono.size());
    std::transform(sum.begin() + static_cast<std::ptrdiff_t>(window),
                   sum.begin() + static_cast<std::ptrdiff_t>(window + mono.size()), result.begin(), toSample);
    return result;
}

} // namespace pacini
