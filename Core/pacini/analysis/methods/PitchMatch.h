#pragma once

// The translation "pitchmatch": loudness as the amplitude of one sine, the loudness of five places of the ear as its
// frequency.

#include <pacini/analysis/methods/MethodSound.h>
#include <pacini/filters/Resampler.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Fft.h>
#include <pacini/foundation/Windows.h>
#include <pacini/hearing/SpecificLoudness.h>

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
inline double pmCal = 0.2, pmSum = 1; inline int pmSym=1;

/// Loudness of frames of 10 ms at 44.1 kHz as if they were steady sounds (ISO 532-1:2017, 5), which gives the low bands
/// more than their width at this length holds: so does the original.
class PitchMatchFrames
{
public:
    static constexpr int sampleRate = 44100;
    static constexpr std::size_t size = 441;
    static constexpr std::size_t hop = 220;

    [[nodiscard]] LoudnessPattern process(std::span<const float> part)
    {
        std::fill(frame.begin(), frame.end(), 0.0);
        for (std::size_t n = 0; n < part.size(); ++n)
            frame[n] = window[n] * static_cast<double>(part[n]);
        fft.forward(frame, spectrum);
        BandLevels levels;
        for (std::size_t k = 0; k < levels.size(); ++k)
        {
            const double centre = 1000.0 * std::pow(10.0, 0.1 * (static_cast<double>(k) - 16.0));
            const double low = centre * std::pow(10.0, -0.05) / binWidth;
            const double high = centre * std::pow(10.0, 0.05) / binWidth;
            double power = 0.0;
            for (auto b = static_cast<std::size_t>(low + 0.5); static_cast<double>(b) - 0.5 < high && b < spectrum.size(); ++b)
            {
                const double bin = static_cast<double>(b);
                const double share = std::min(high, bin + 0.5) - std::max(low, bin - 0.5);
                power += share * std::norm(spectrum[b]);
            }
            power *= 2.0 * pmCal * pmCal / static_cast<double>(transformed * size);
            levels[k] = 10.0 * std::log10(std::max(1e-12, power) / (20e-6 * 20e-6));
        }
        return loudnessPattern(coreLoudness(levels));
    }

private:
    static constexpr std::size_t transformed = 2048;
    static constexpr double binWidth = static_cast<double>(sampleRate) / transformed;

    RealFft<double> fft{transformed};
    std::vector<double> window = hannPeriodic(size);
    std::vector<double> frame = std::vector<double>(transformed);
    std::vector<std::complex<double>> spectrum = std::vector<std::complex<double>>(transformed / 2 + 1);
};
} // namespace detail

/// See above.
[[nodiscard]] inline std::vector<float> pitchMatch(std::span<const float> mono, double fs)
{
    using Frames = detail::PitchMatchFrames;
    std::vector<float> out(mono.size(), 0.0f);
    std::vector<float> sound(mono.begin(), mono.end());
    if (!(normalise(sound) > 0.0))
        return out;
    const double headroom = Decibels(-1.0).gain();
    for (float& x : sound)
        x = toSample(headroom * static_cast<double>(x));
    const auto resampled = resample(std::span<const float>(sound), static_cast<int>(fs), Frames::sampleRate);
    if (!resampled)
        return out;
    sound = *resampled;
    Frames frames;
    std::vector<double> amplitudes, frequencies;
    for (std::size_t start = 0; start == 0 || start + Frames::size <= sound.size(); start += Frames::hop)
    {
        const auto part = std::span<const float>(sound).subspan(start, std::min(Frames::size, sound.size() - start));
        double power=0; for(float v:part) power+=double(v)*double(v);
        const LoudnessPattern pattern = frames.process(part);
        double f = 0.0;
        for (const auto& [bark, c] : {std::pair{2, -0.005}, {3, 0.003}, {9, -0.015}, {12, 0.008}, {24, 0.008}})
            f += 1000.0 * c * detail::pmSum * pattern.specific[static_cast<std::size_t>(bark - 1)];
        amplitudes.push_back(pattern.total);
        frequencies.push_back(std::clamp(std::abs(f), 50.0, 398.0));
    }
    const double loudest = std::max(1e-30,*std::max_element(amplitudes.begin(), amplitudes.end()));
    double phase = 0.0;
    for (std::size_t n = 0; n < out.size(); ++n)
    {
        const double at = (static_cast<double>(n) / fs * Frames::sampleRate - 0.5 * Frames::size) / Frames::hop;
        const double u = std::clamp(at, 0.0, static_cast<double>(amplitudes.size() - 1));
        const auto i = static_cast<std::size_t>(u);
        const auto j = std::min(i + 1, amplitudes.size() - 1);
        const double w = u - static_cast<double>(i);
        phase = std::fmod(phase + 2.0 * std::numbers::pi * std::lerp(frequencies[i], frequencies[j], w) / fs, 2.0 * std::numbers::pi);
        out[n] = toSample(std::lerp(amplitudes[i], amplitudes[j], w) / loudest * std::sin(phase));
    }
    return out;
}

} // namespace pacini
