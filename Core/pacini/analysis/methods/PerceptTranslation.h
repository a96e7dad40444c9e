#pragma once

// The translation "percept": loudness and roughness of the sound as intensity and roughness of two sines.

#include <pacini/analysis/methods/MethodSound.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Fft.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
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

/// Loudness and roughness of a frame of 4096 samples at 44.1 kHz, and the amplitudes of two sines with the same effect
/// on the skin. Numbers of equations are those of Lee and Choi (2013).
class PerceptFrame
{
public:
    static constexpr std::size_t size = 4096;
    static constexpr int sampleRate = 44100;

    struct Amplitudes
    {
        double low = 0.0;
        double high = 0.0;
    };

    [[nodiscard]] Amplitudes process(std::span<const double> frame)
    {
        fft.forward(frame, spectrum);
        for (std::size_t k = 0; k < magnitudes.size(); ++k)
            magnitudes[k] = std::abs(spectrum[first + k]);
        return amplitudes(loudness(), roughness());
    }

private:
    static constexpr double binWidth = static_cast<double>(sampleRate) / size;
    static constexpr std::size_t first = 3;  // from 25 Hz on
    static constexpr std::size_t last = 594; // up to 6400 Hz

    [[nodiscard]] static double frequency(std::size_t k) noexcept { return binWidth * static_cast<double>(first + k); }

    /// The level that is as loud as 60 phon, dB: ISO 226:2003, in straight lines over the frequency.
    [[nodiscard]] static double equallyLoud(double f) noexcept
    {
        static constexpr std::array<std::pair<double, double>, 25> contour{
            {{25, 104.23},  {31.5, 99.08}, {40, 94.18},   {50, 89.96},   {63, 85.94},   {80, 82.05},   {100, 78.65},
             {125, 75.56},  {160, 72.47},  {200, 69.86},  {250, 67.53},  {315, 65.39},  {400, 63.45},  {500, 62.05},
             {630, 60.81},  {800, 59.89},  {1000, 60.01}, {1250, 62.15}, {1600, 63.19}, {2000, 59.96}, {2500, 57.26},
             {3150, 56.42}, {4000, 57.57}, {5000, 60.89}, {6300, 66.36}}};
        const auto above = std::find_if(contour.begin(), contour.end(), [f](auto point) { return point.first > f; });
        if (above == contour.begin())
            return contour.front().second;
        if (above == contour.end())
            return contour.back().second;
        const auto [f0, level0] = *(above - 1);
        return std::lerp(level0, above->second, (f - f0) / (above->first - f0));
    }

    /// Equation 1.
    [[nodiscard]] double loudness() const
    {
        double sum = 0.0;
        for (std::size_t k = 0; k < magnitudes.size(); ++k)
            sum += Decibels::fromGain(1.37 * magnitudes[k] + 1e-12).value / contour[k];
        return std::max(0.0, 0.065 * sum);
    }

    /// Equation 2, over all pairs of peaks within 40 dB of the largest (P. Vassilakis, 2001).
    [[nodiscard]] double roughness()
    {
        peaks.clear();
        const double least = 0.01 * *std::max_element(magnitudes.begin(), magnitudes.end());
        for (std::size_t k = 1; k + 1 < magnitudes.size(); ++k)
            if (magnitudes[k] > magnitudes[k - 1] && magnitudes[k] > magnitudes[k + 1] && magnitudes[k] >= least)
                peaks.push_back(k);
        double sum = 0.0;
        for (std::size_t i = 0; i < peaks.size(); ++i)
        {
            const double s = 0.24 / (0.0207 * frequency(peaks[i]) + 18.96);
            for (std::size_t j = i + 1; j < peaks.size(); ++j)
            {
                const double distance = s * (frequency(peaks[j]) - frequency(peaks[i]));
                if (distance > 12.0) // the rest is below 1e-18 of the largest
                    break;
                const auto [weak, strong] = std::minmax(magnitudes[peaks[i]], magnitudes[peaks[j]]);
                sum += 0.5 * std::pow(weak * strong, 0.1) * std::pow(2.0 * weak / (weak + strong), 3.11) *
                       (std::exp(-3.5 * distance) - std::exp(-5.75 * distance));
            }
        }
        return sum;
    }

    /// Equations 5 to 7 and 9, with the constants for games and films.
    [[nodiscard]] static Amplitudes amplitudes(double heardLoudness, double heardRoughness) noexcept
    {
        const double intensity = 0.035 * std::sqrt(heardLoudness) * heardRoughness * heardRoughness - 0.40;
        if (!(intensity > 0.0))
            return {};
        const double roughness = std::min(heardRoughness, 801.0 / 113.0 + 0.529 * intensity + 0.479);
        const double root = std::sqrt(std::max(0.0, 801.0 - 113.0 * (roughness - 0.529 * intensity - 0.479)));
        double share = 28.3 / 56.3; // of the higher sine: the smaller root within 0 to 1
        for (const double candidate : {28.3 + root, 28.3 - root})
            if (candidate >= 0.0 && candidate <= 56.3)
                share = candidate / 56.3;
        const double amplitude = (25.8 * share * share - 25.5 * share + roughness - 0.203) / 3.98;
        return {amplitude * amplitude * (1.0 - share), amplitude * amplitude * share};
    }

    [[nodiscard]] static std::vector<double> contourOfBins()
    {
        std::vector<double> levels;
        for (std::size_t k = 0; k <= last - first; ++k)
            levels.push_back(equallyLoud(frequency(k)));
        return levels;
    }

    RealFft<double> fft{size};
    std::vector<std::complex<double>> spectrum = std::vector<std::complex<double>>(size / 2 + 1);
    std::vector<double> magnitudes = std::vector<double>(last - first + 1);
    std::vector<double> contour = contourOfBins();
    std::vector<std::size_t> peaks;
};

} // namespace detail

/// Two sines of 175 and 210 Hz, which beat, whose amplitudes change every 93 ms so that their intensity and roughness
/// are felt like loudness and roughness of that part of the sound are heard (J. Lee and S. Choi, "Real-Time
/// Perception-Level Translation from Audio Signals to Vibrotactile Effects", CHI 2013). The sound's peak is scaled to
/// full scale before, the result to a root mean square of .15. As long as the input; fs is 8000 to 768000 Hz, whole;
/// NaN and infinities count as 0.
[[nodiscard]] inline std::vector<float> perceptTranslation(std::span<const float> mono, double fs)
{
    using Frame = detail::PerceptFrame;
    std::vector<float> out(mono.size(), 0.0f);
    const auto sound = normalisedAt(mono, fs, Frame::sampleRate);
    Frame analysis;
    std::vector<double> frame(Frame::size);
    constexpr double seconds = static_cast<double>(Frame::size) / Frame::sampleRate;
    double power = 0.0;
    for (std::size_t i = 0; i * Frame::size < sound.size(); ++i)
    {
        const auto part =
            std::span(sound).subspan(i * Frame::size, std::min(Frame::size, sound.size() - i * Frame::size));
        std::fill(std::copy(part.begin(), part.end(), frame.begin()), frame.end(), 0.0);
        const auto amplitudes = analysis.process(frame);
        const auto frameAt = [&](std::size_t k)
        {
            return std::min(out.size(), static_cast<std::size_t>(std::round(static_cast<double>(k) * seconds * fs)));
        };
        for (std::size_t n = frameAt(i); n < frameAt(i + 1); ++n)
        {
            const double angle = 2.0 * std::numbers::pi * static_cast<double>(n - frameAt(i)) / fs;
            const double y = amplitudes.low * std::sin(175.0 * angle) + amplitudes.high * std::sin(210.0 * angle);
            power += y * y;
            out[n] = toSample(y);
        }
    }
    const double scale = power > 0.0 ? 0.15 * std::sqrt(static_cast<double>(out.size()) / power) : 0.0;
    for (float& x : out)
        x = std::clamp(static_cast<float>(scale * static_cast<double>(x)), -1.0f, 1.0f);
    return out;
}

} // namespace pacini
