#pragma once

// The translation "pitchmatch": loudness as the amplitude of one sine, the loudness at five places of the ear as its
// frequency.

#include <pacini/analysis/methods/MethodSound.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Fft.h>
#include <pacini/foundation/Units.h>
#include <pacini/foundation/Windows.h>
#include <pacini/hearing/SpecificLoudness.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

namespace detail
{

/// Loudness of frames of 10 ms at 44.1 kHz, each as a steady sound (ISO 532-1:2017, 5).
class PitchMatchFrames
{
public:
    static constexpr int sampleRate = 44100;
    static constexpr std::size_t size = 441;
    static constexpr std::size_t hop = 220;

    /// What is heard of the next frame; nothing of one whose root mean square is below .001.
    [[nodiscard]] std::optional<LoudnessPattern> process(std::span<const float> samples)
    {
        std::fill(frame.begin(), frame.end(), 0.0);
        double energy = 0.0;
        for (std::size_t n = 0; n < samples.size(); ++n)
        {
            frame[n] = window[n] * static_cast<double>(samples[n]);
            energy += frame[n] * frame[n];
        }
        if (energy < 1e-6 * size)
            return std::nullopt;
        fft.forward(frame, spectrum);
        BandPowers powers;
        for (std::size_t k = 0; k < powers.size(); ++k)
            powers[k] = std::max(quietest, bandPower(k)) / (reference * reference);
        return loudnessPattern(coreLoudness(powers));
    }

private:
    static constexpr std::size_t transformed = 2048; // frame and zeros
    static constexpr double binWidth = static_cast<double>(sampleRate) / transformed;
    static constexpr double reference = 20e-6; // Pa
    static constexpr double quietest = 1e-12;  // Pa^2, as the standard adds
    /// Pressure of a sample of 1. With 2 the frequencies are, on average, those of vibrations that others made.
    static constexpr double pascals = 2.0;

    /// Mean square in the third octave `k` from 25 Hz on, Pa^2. Bins count with the share of their width.
    [[nodiscard]] double bandPower(std::size_t k) const
    {
        const double centre = 1000.0 * std::pow(10.0, 0.1 * (static_cast<double>(k) - 16.0)) / binWidth;
        const double low = centre * std::pow(10.0, -0.05);
        const double high = centre * std::pow(10.0, 0.05);
        double sum = 0.0;
        for (auto b = static_cast<std::size_t>(low + 0.5); static_cast<double>(b) - 0.5 < high; ++b)
        {
            const auto bin = static_cast<double>(b);
            sum += (std::min(high, bin + 0.5) - std::max(low, bin - 0.5)) * std::norm(spectrum[b]);
        }
        return 2.0 * pascals * pascals / static_cast<double>(transformed * size) * sum;
    }

    RealFft<double> fft{transformed};
    std::vector<double> window = hannPeriodic(size);
    std::vector<double> frame = std::vector<double>(transformed);
    std::vector<std::complex<double>> spectrum = std::vector<std::complex<double>>(transformed / 2 + 1);
};

/// Amplitude and frequency of the sine, a value each PitchMatchFrames::hop.
struct PitchMatchTrack
{
    std::vector<double> amplitude; ///< sone
    std::vector<double> frequency; ///< Hz
};

/// `sound` at PitchMatchFrames::sampleRate, the largest magnitude 1.
[[nodiscard]] inline PitchMatchTrack pitchMatchTrack(std::span<const float> sound)
{
    constexpr double lowest = 50.0;
    constexpr double highest = 398.0;
    PitchMatchTrack track;
    PitchMatchFrames frames;
    std::vector<double> raw;
    for (std::size_t start = 0; start == 0 || start + PitchMatchFrames::size <= sound.size();
         start += PitchMatchFrames::hop)
    {
        const auto pattern =
            frames.process(sound.subspan(start, std::min(PitchMatchFrames::size, sound.size() - start)));
        track.amplitude.push_back(pattern ? pattern->total : 0.0);
        if (!pattern)
        {
            raw.push_back(raw.empty() ? 0.5 * (lowest + highest) : raw.back());
            continue;
        }
        double f = 0.0; // sone in tenths of a Bark, summed over the Bark, times 1000
        for (const auto& [bark, weight] : {std::pair{2, -50.0}, {3, 30.0}, {9, -150.0}, {12, 80.0}, {24, 80.0}})
            f += weight * pattern->specific[static_cast<std::size_t>(bark - 1)];
        raw.push_back(std::clamp(std::abs(f), lowest, highest));
    }
    for (std::size_t i = 0; i < raw.size(); ++i)
    {
        const std::size_t first = i == 0 ? 0 : i - 1;
        const std::size_t end = std::min(raw.size(), i + 2);
        double sum = 0.0;
        for (std::size_t k = first; k < end; ++k)
            sum += raw[k];
        track.frequency.push_back(sum / static_cast<double>(end - first));
    }
    return track;
}

} // namespace detail

/// A sine whose amplitude is the loudness of 10 ms, each heard by itself, and whose frequency (50 to 398 Hz) follows
/// the loudness in the Barks 2, 3, 9, 12 and 24 (D.-G. Kim, J. Lee, G. Yun, H. Z. Tan and S. Choi, "Sound-to-Touch
/// Crossmodal Pitch Matching for Short Sounds", IEEE ToH 17 (2024), as Y. Li and H. Seifi used it for longer sounds in
/// "Sound2Hap", CHI 2026). The sound's peak is scaled to -1 dB of full scale before, the largest amplitude to full
/// drive. As long as the input; fs is 8000 to 768000 Hz, whole; NaN and infinities count as 0.
[[nodiscard]] inline std::vector<float> pitchMatch(std::span<const float> mono, double fs)
{
    using Frames = detail::PitchMatchFrames;
    std::vector<float> out(mono.size(), 0.0f);
    const auto sound = normalisedAt(mono, fs, Frames::sampleRate, Decibels(-1.0).gain());
    if (sound.empty())
        return out;
    const auto [amplitude, frequency] = detail::pitchMatchTrack(sound);
    const double loudest = *std::max_element(amplitude.begin(), amplitude.end());
    if (!(loudest > 0.0))
        return out;
    const std::size_t last = amplitude.size() - 1;
    double phase = 0.0;
    for (std::size_t n = 0; n < out.size(); ++n)
    {
        const double at = (static_cast<double>(n) / fs * Frames::sampleRate - 0.5 * Frames::size) / Frames::hop;
        const double inside = std::clamp(at, 0.0, static_cast<double>(last));
        const auto i = static_cast<std::size_t>(inside);
        const std::size_t next = std::min(i + 1, last);
        const double share = inside - static_cast<double>(i);
        out[n] = toSample(std::lerp(amplitude[i], amplitude[next], share) / loudest * std::sin(phase));
        phase = std::fmod(phase + 2.0 * std::numbers::pi * std::lerp(frequency[i], frequency[next], share) / fs,
                          2.0 * std::numbers::pi);
    }
    return out;
}

} // namespace pacini
